// Maps a line and column that Mesa printed to a place in the text that it was given. Mesa's numbers count its
// preprocessor's output; places that are uncertain are left out.
#pragma once

#include "glsl/syntax/preprocess.hpp"
#include "text/tokens.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// Counted from 1, in bytes; column 0 means unknown.
struct DriverPlace {
    int line = 0;
    int column = 0;
};

/// Mesa's preprocessor replaces each run of blanks and comments by one blank, moves joined lines and the rest
/// of a comment into the line where they begin, drops line ends within a macro's arguments, and counts
/// columns in the expanded text.
class DriverPlaces {
public:
    /// `text` must outlive this object.
    explicit DriverPlaces(std::string_view text);

    /// Maps a place printed by the compiler. `name` is the identifier at that place, if known, and finds it
    /// after an expanded macro; else empty.
    DriverPlace of_compiler(int line, int column, std::string_view name) const;

    /// Maps a place printed by the preprocessor, whose lines and columns are those of the text.
    DriverPlace of_preprocessor(int line, int column) const;

    /// The text between two tokens.
    struct Gap {
        int breaks = 0;      ///< line ends that the preprocessor keeps
        int row_line = 0;    ///< the line after the last of those
        bool spaced = false; ///< blanks or comments after that line end
        int lines = 0;       ///< lines that those line ends produce, including postponed ones
        int put_off = 0;     ///< line ends of comments and joined lines, postponed to the next kept one
    };

private:
    /// A line of the preprocessor's output.
    struct Row {
        int line;
        size_t begin;
        size_t end;       ///< one past its last token
        bool indented;    ///< begins with a blank
        size_t known_end; ///< columns are known for the tokens before this one
    };

    void read_rows();
    Gap gap_before(size_t token, int put_off = 0) const;
    std::optional<size_t> end_of_call(size_t name, bool certain) const;
    const Row* row_at(int line) const;

    std::string_view text_;
    std::vector<text::Token> tokens_;
    Preprocessed preprocessed_;
    std::vector<Row> rows_; ///< in ascending order of line
};

} // namespace tidemark::glsl
