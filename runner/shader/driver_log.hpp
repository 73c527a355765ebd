// Parses driver logs into messages about the author's own lines; estimates how much work a text is for a
// driver.
#pragma once

#include "base/error.hpp"
#include "base/mapped_text.hpp"
#include "base/tokens.hpp"
#include "scene/scene.hpp"
#include "shader/shader_source.hpp"
#include "shader/token_reading.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

/// One line of a log.
struct DriverMessage {
    Diagnostic diagnostic;
    bool follows = false; ///< caused by an earlier error; nothing to fix here
};

/// Reads the formats of Mesa `0:12(5): error: …`, NVIDIA `0(12) : error C1008: …`, and Intel, AMD and ANGLE
/// `ERROR: 0:12: …`. A line in another format, or about a generated line, has no place. A message has no
/// column if the driver prints none, or if its column counts expanded macros. Of the overloads that Mesa
/// lists for a failed call, three are kept, as notes. Names have the author's spelling where the driver was
/// given another.
std::vector<DriverMessage> parse_driver_log(std::string_view log, const text::MappedText& source);

/// Drops messages that follow from others, and counts them in a note under the error that caused them. Errors
/// come first.
std::vector<Diagnostic> for_people(const std::vector<DriverMessage>& messages);

// Maps a line and column that Mesa printed to a place in the text that it was given. Mesa's numbers count its
// preprocessor's output; places that are uncertain are left out.

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

// Reads the number of a shader's instructions from a driver's messages. Their formats follow no standard: a
// message that does not match clearly is ignored.

struct InstructionCount {
    std::string shader; ///< the driver's name for it: `FS SIMD8`
    int instructions = 0;

    bool operator==(const InstructionCount&) const = default;
};

/// Reads Mesa's formats: `FS SIMD8 shader: 123 inst, 0 loops, …` (Intel; Adreno, Panfrost and others alike),
/// `… prog 1/2: 123 instructions, …` (VideoCore) and `type: 4, …, inst: 123, …` (nouveau). AMD's messages
/// have the code size but no count.
std::optional<InstructionCount> read_instruction_count(std::string_view message);

// Estimates from the text how much work it is for a driver to compile it. A conservative guess, since drivers
// differ. Runs no driver.

struct DriverLoad {
    bool followed = false; ///< false: the text was not understood and the numbers are meaningless
    size_t words = 0;      ///< after macro expansion
    int depth = 0;         ///< nesting of expressions and blocks; a sum of three has depth two
    double inlined = 0;    ///< words of the longest function after inlining all calls
    int loops = 0;         ///< nested loops, calls included; a driver may unroll all of them
    /// may contain -2147483648 / -1, which crashes some drivers when they fold constants
    bool edge_of_int = false;
    double elements = 0; ///< numbers in all arrays and large structures; infinite if a length is unknown

    /// Returns whether drivers compile the text in a second or two, as measured on llvmpipe with some margin.
    bool modest() const;
};

/// Measures a text; `followed` is false if its directives cannot be evaluated. Linear in its words.
DriverLoad driver_load(const text::MappedText& source);

/// Returns whether every pass of the scene is modest in its first dialect.
bool is_modest(const scene::Scene& scene, Precision precision);

} // namespace tidemark::glsl
