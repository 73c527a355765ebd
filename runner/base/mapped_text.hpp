// A text with the file and line that each of its lines comes from. `append` joins files, includes and
// generated lines; `locate` maps a message about line N of the whole back to the author's file.
#pragma once

#include "base/error.hpp"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::text {

/// Maps a line of the whole text (counted from 1) to the author's file and line.
class LineMap {
public:
    /// Declares that lines from `line` on come from `file`, from `source_line` on, until the next run begins.
    void begin_run(int line, std::string_view file, int source_line);

    /// Returns the place where `line` was written. Generated lines have an empty file name.
    SourceLocation locate(int line, int column = 0) const;

    /// Appends the runs of `other`; its line 1 is `first_line` here.
    void append(const LineMap& other, int first_line);

    /// From `column` of `line` on, the author's column is `by` larger (smaller if negative) than without this
    /// shift. Shifts are passed in ascending order of place.
    struct Shift {
        int line;
        int column;
        int by;
    };
    void shift(const std::vector<Shift>& shifts);

private:
    int shift_at(int line, int column) const;

    struct Run {
        int line;
        int file;
        int source_line;
    };
    std::vector<std::string> files_;
    std::vector<Run> runs_;     // ascending in `line`
    std::vector<Shift> shifts_; // ascending; each applies until the next one of its line
};

/// Replaces the characters [begin, end) with `replacement`.
struct Edit {
    size_t begin = 0;
    size_t end = 0;
    std::string replacement{};
};

/// Text with its LineMap. Every chunk starts on a new line, and the whole ends with a newline. Where a
/// backslash and a line end split a token, as GLSL allows, the rest of the joined lines stands on the first.
class MappedText {
public:
    void append(std::string_view chunk, std::string_view file, int first_line);
    void append(const MappedText& other);
    /// Appends lines that have no author.
    void append_generated(std::string_view chunk) { append(chunk, {}, 0); }

    /// Applies edits that are sorted by `begin` and do not overlap. Line breaks that an edit removes are
    /// inserted after its replacement, so that no line moves; a replacement must not contain any.
    void apply(const std::vector<Edit>& edits);

    const std::string& text() const { return text_; }
    const LineMap& lines() const { return lines_; }
    int line_count() const { return line_count_; }

private:
    void append_lines(std::string_view chunk);

    std::string text_;
    LineMap lines_;
    int line_count_ = 0;
};

/// Returns the text with CR LF and lone CR replaced by LF, and without a byte-order mark.
std::string with_plain_line_ends(std::string text);

// Expands `#include "…"` and `#include <tidemark/…>`: pastes the files into one MappedText. Reads files only
// through the given function.

using ReadText = std::function<Result<std::string>(const std::filesystem::path&)>;

/// One `#include` line: the range of the directive, and the name between its quotes or after `<tidemark/`.
struct Include {
    size_t begin = 0;
    size_t end = 0;
    int line = 0;
    std::string name = {};
    bool of_library = false;
    bool in_angles = false;   ///< `<name>` that is not in our library
    bool conditional = false; ///< is inside an #if
};

/// Returns the includes in text order.
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
