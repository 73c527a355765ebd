// What a file declares at its outermost level: functions, global variables, structures, macros, knobs, each
// with its place and the comment above it. Reads tokens, never fails; what macros declare is not seen.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tidemark::lsp {

struct Symbol {
    enum class Kind { function, variable, constant, structure, macro, knob };
    Kind kind = Kind::variable;
    std::string name;
    std::string signature; ///< on one line, as written: `float sdf(vec3 p)`
    std::string comment;   ///< above it, without its marks; may be empty
    size_t begin = 0;      ///< all of it, in bytes from the text's begin
    size_t end = 0;
    size_t name_begin = 0;

    size_t name_end() const { return name_begin + name.size(); }
};

/// In the order of the text.
std::vector<Symbol> outline(std::string_view text);

} // namespace tidemark::lsp
