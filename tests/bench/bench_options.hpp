// The command line of a benchmark, and the context that it draws in.
#pragma once

#include "base/extent.hpp"
#include "host/gl_context.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace tidemark::bench {

/// Returns the files among the words. `option(word, next)` returns how many words it takes: 0 for a file;
/// `next` is null at the end.
template <class Option>
std::vector<std::string> files_of(int count, char** arguments, const Option& option) {
    std::vector<std::string> files;
    for (int i = 1; i < count;) {
        const char* const next = i + 1 < count ? arguments[i + 1] : nullptr;
        const int taken = option(std::string(arguments[i]), next);
        if (taken == 0)
            files.emplace_back(arguments[i]);
        i += taken == 0 ? 1 : taken;
    }
    return files;
}

inline void read_size(const char* text, Extent& extent) {
    std::sscanf(text, "%dx%d", &extent.width, &extent.height);
}

/// Returns a context, or ends the process with the code for a test that cannot run.
inline host::HeadlessContext context_or_exit() {
    auto context = host::HeadlessContext::create();
    if (!context) {
        fmt::print(stderr, "{}\n", to_string(context.error()));
        std::exit(77);
    }
    return *std::move(context);
}

} // namespace tidemark::bench
