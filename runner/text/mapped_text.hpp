// A text that knows where each of its lines was written. Files, includes and generated lines are put
// together with `append`; a message about line N of the whole is sent back to its author with `locate`.
#pragma once

#include "base/error.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tidemark::text {

/// From a line of the whole text (counted from 1) to the author's file and line.
class LineMap {
public:
    /// Lines from `line` on were written in `file` from `source_line` on, until the next run begins.
    void begin_run(int line, std::string_view file, int source_line);

    /// Where `line` was written. A line of our own making has an empty file name.
    SourceLocation locate(int line, int column = 0) const;

    /// The runs of `other`, whose line 1 stands at `first_line` here.
    void append(const LineMap& other, int first_line);

    /// On `line`, what stands from `column` on was written `by` columns further right (left where negative)
    /// than it would be found without this call. In ascending order of places.
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
    std::vector<Shift> shifts_; // ascending; each holds up to the next of its line
};

/// Replace the characters [begin, end) by `replacement`.
struct Edit {
    size_t begin = 0;
    size_t end = 0;
    std::string replacement{};
};

/// Text with its LineMap. Every chunk starts on a line of its own and the whole ends with a newline.
class MappedText {
public:
    void append(std::string_view chunk, std::string_view file, int first_line);
    void append(const MappedText& other);
    /// Lines of our own making.
    void append_generated(std::string_view chunk) { append(chunk, {}, 0); }

    /// Applies edits that are sorted by `begin` and do not overlap. Line breaks that an edit removes are
    /// put back behind its replacement, so that no line moves; a replacement must not contain any.
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

/// The text with CR LF and lone CR turned into LF and a byte-order mark dropped.
std::string with_plain_line_ends(std::string text);

} // namespace tidemark::text
