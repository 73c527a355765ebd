#include "cli/console.hpp"

#include "base/printable.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <string>

namespace tidemark::cli {

namespace {

std::atomic<bool> words_are_wanted{true};

} // namespace

void say(std::string_view line) {
    if (words_are_wanted)
        say_to_programs(line);
}

void say_to_programs(std::string_view line) {
    const std::string text = printable(line) + '\n'; // one write, so that lines of several threads do not mix
    (void)std::fwrite(text.data(), 1, text.size(), stderr);
}

void keep_words_back() {
    words_are_wanted = false;
}

Result<void> put(std::string_view text) {
    const std::string shown = printable(text);
    return put(std::as_bytes(std::span(shown)));
}

Result<void> put_exact(std::string_view text) {
    return ::isatty(STDOUT_FILENO) == 1 ? put(text) : put(std::as_bytes(std::span(text)));
}

Result<void> put(std::span<const std::byte> bytes) {
    const bool written = std::fwrite(bytes.data(), 1, bytes.size(), stdout) == bytes.size();
    if (written && std::fflush(stdout) == 0)
        return {};
    return fail(ErrorCode::write, fmt::format("cannot write to standard output: {}", system_reason(errno)));
}

} // namespace tidemark::cli
