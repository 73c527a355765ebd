// `#include "…"`, `#include <tidemark/…>`: pastes files into one MappedText. Reads files only through the
// function it is given.
#pragma once

#include "base/result.hpp"
#include "text/mapped_text.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::text {

using ReadText = std::function<Result<std::string>(const std::filesystem::path&)>;

/// One `#include` line: the directive's characters and the name between its quotes, or behind `<tidemark/`.
struct Include {
    size_t begin = 0;
    size_t end = 0;
    int line = 0;
    std::string name = {};
    bool of_library = false;
    bool conditional = false; ///< stands under an #if
};

/// In the order of the text; `#include <name>` of another library is left out.
std::vector<Include> find_includes(std::string_view text);

struct ExpandedText {
    MappedText text;
    std::vector<std::filesystem::path> files; ///< every file read, the first one first, each once
    std::vector<std::filesystem::path>
        missing; ///< named under an `#if`, and not to be read: left to the driver
};

/// `path` with every `#include "name"` (relative to the file that says it) replaced by that file's text, at
/// each occurrence; `#include <tidemark/name>` is the file of that name in the folder `library`. Another
/// `#include <name>`, and one under an `#if` whose file does not exist, are left for the driver. Cycles and
/// missing files are errors that name the chain of includes.
Result<ExpandedText> expand_includes(const std::filesystem::path& path, const ReadText& read,
                                     const std::filesystem::path& library);

} // namespace tidemark::text
