// The declarations of a file at its outermost level: functions, global variables, structures, macros and
// knobs, each with its place and the comment above it. Reads tokens and never fails; does not expand macros.
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
    std::string comment;   ///< the one above it, without its marks; may be empty
    size_t begin = 0;      ///< of the whole declaration, in bytes from the text's beginning
    size_t end = 0;
    size_t name_begin = 0;

    size_t name_end() const { return name_begin + name.size(); }
};

/// Returns the declarations in the order of the text.
std::vector<Symbol> outline(std::string_view text);

} // namespace tidemark::lsp
