// Which parts of a text the driver's preprocessor keeps, as far as can be known without the driver: reads #if
// and #define, expands no macro in code. Never fails, and is linear in the text.
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

/// What ShaderToy's texts find defined.
inline constexpr KnownMacro k_site_macros[] = {
    {"HW_PERFORMANCE", 1}, {"GL_ES", 1}, {"__VERSION__", 300}, {"GL_FRAGMENT_PRECISION_HIGH", 1}};

/// A #define or #undef that is not inactive. The numbers are indices of tokens.
struct MacroLine {
    std::string_view name;
    size_t hash;     ///< its `#`
    size_t body;     ///< first token of what it stands for
    size_t end;      ///< one past its last token
    bool parameters; ///< `#define NAME(…)`
    bool undefines;  ///< `#undef NAME`
    Activity activity;
};

struct Preprocessed {
    std::vector<Activity> activity; ///< of each token
    std::vector<size_t> code;       ///< the tokens that are neither inactive nor in a directive
    std::vector<MacroLine> macros;  ///< in the order of the text
    std::vector<size_t> directives; ///< the `#` of every other directive that is not inactive
};

/// With `all_known`, no macro but those of `known` is defined before the text begins; without, the driver may
/// define any that begins with GL_.
Preprocessed preprocess(const std::vector<text::Token>& tokens,
                        std::span<const KnownMacro> known = k_site_macros, bool all_known = false);

} // namespace tidemark::glsl
