// Where a driver's line and column stand in the text that it was given. In come the numbers that Mesa prints,
// which count what its preprocessor left of the text; what cannot be known for certain is left out.
#pragma once

#include "glsl/syntax/preprocess.hpp"
#include "text/tokens.hpp"

#include <optional>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// Counted from 1, in bytes; a column of 0 is not known.
struct DriverPlace {
    int line = 0;
    int column = 0;
};

/// Mesa's preprocessor turns each run of blanks and comments into one blank, puts a joined line and the rest
/// of a comment into the line where they begin, drops the line ends within a macro's arguments, and counts
/// what macros stand for.
class DriverPlaces {
public:
    /// `text` must live as long.
    explicit DriverPlaces(std::string_view text);

    /// What the compiler said of `line` and `column`. `name` is the word that stands there, where that is
    /// known, and finds the place behind a macro; else empty.
    DriverPlace of_compiler(int line, int column, std::string_view name) const;

    /// What the preprocessor said: it counts the author's lines, and columns as they stand there.
    DriverPlace of_preprocessor(int line, int column) const;

    /// What lies between two tokens.
    struct Gap {
        int breaks = 0;      ///< line ends that the preprocessor sees as such
        int row_line = 0;    ///< the line behind the last of those
        bool spaced = false; ///< blanks or comments, behind that line end
        int lines = 0;       ///< that those line ends make, with the ones put off until then
        int put_off = 0;     ///< line ends of comments and joined lines, until the next that is seen
    };

private:
    /// A line of what the preprocessor leaves.
    struct Row {
        int line;
        size_t begin;
        size_t end;       ///< one past its last token
        bool indented;    ///< begins with a blank
        size_t known_end; ///< columns are known of the tokens before
    };

    void read_rows();
    Gap gap_before(size_t token, int put_off = 0) const;
    std::optional<size_t> end_of_call(size_t name, bool certain) const;
    const Row* row_at(int line) const;

    std::string_view text_;
    std::vector<text::Token> tokens_;
    Preprocessed preprocessed_;
    std::vector<Row> rows_; ///< their lines ascend
};

} // namespace tidemark::glsl
