// Finds the parts of a text that the driver's preprocessor keeps, as far as they can be known without the
// driver. Evaluates #if and #define; does not expand macros in code. Never fails; linear in the text.
#pragma once

#include "text/tokens.hpp"

#include <span>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

enum class Activity : unsigned char { inactive, unknown, active };

/// A macro that is defined before the text begins.
struct KnownMacro {
    std::string_view name;
    long value;
};

/// Macros that ShaderToy predefines.
inline constexpr KnownMacro k_site_macros[] = {
    {"HW_PERFORMANCE", 1}, {"GL_ES", 1}, {"__VERSION__", 300}, {"GL_FRAGMENT_PRECISION_HIGH", 1}};

/// A #define or #undef that is not inactive. Numbers are token indices.
struct MacroLine {
    std::string_view name;
    size_t hash;     ///< its `#`
    size_t body;     ///< first token of the replacement
    size_t end;      ///< one past its last token
    bool parameters; ///< `#define NAME(…)`
    bool undefines;  ///< `#undef NAME`
    Activity activity;
};

struct Preprocessed {
    std::vector<Activity> activity; ///< one entry for each token
    std::vector<size_t> code;       ///< the tokens that are neither inactive nor in a directive
    std::vector<MacroLine> macros;  ///< in text order
    std::vector<size_t> directives; ///< the `#` of every other directive that is not inactive
};

/// With `all_known`, only the macros in `known` are predefined; without it, the driver may also define names
/// that begin with GL_.
Preprocessed preprocess(const std::vector<text::Token>& tokens,
                        std::span<const KnownMacro> known = k_site_macros, bool all_known = false);

} // namespace tidemark::glsl
