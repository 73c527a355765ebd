// Expands `#include "…"` and `#include <tidemark/…>`: pastes the files into one MappedText. Reads files only
// through the given function.
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

/// One `#include` line: the range of the directive, and the name between its quotes or after `<tidemark/`.
struct Include {
    size_t begin = 0;
    size_t end = 0;
    int line = 0;
    std::string name = {};
    bool of_library = false;
    bool conditional = false; ///< is inside an #if
};

/// Returns the includes in text order, without `#include <name>` of other libraries.
std::vector<Include> find_includes(std::string_view text);

struct ExpandedText {
    MappedText text;
    std::vector<std::filesystem::path> files; ///< every file read, once each; the top file first
    std::vector<std::filesystem::path>
        /// files that an #include inside an #if names and that cannot be read; those lines are left for the
        /// driver
        missing;
};

/// Reads `path` and replaces every `#include "name"` (relative to the including file) with that file's text,
/// at each occurrence; `#include <tidemark/name>` reads that file from the folder `library`. Any other
/// `#include <name>`, and one inside an #if whose file does not exist, stays for the driver. Include cycles
/// and missing files are errors that list the chain of includes.
Result<ExpandedText> expand_includes(const std::filesystem::path& path, const ReadText& read,
                                     const std::filesystem::path& library);

} // namespace tidemark::text
