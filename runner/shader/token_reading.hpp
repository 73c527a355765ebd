// Finds the parts of a text that the driver's preprocessor keeps, as far as they can be known without the
// driver. Evaluates #if and #define; does not expand macros in code. Never fails; linear in the text.
#pragma once

#include "base/mapped_text.hpp"
#include "base/tokens.hpp"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
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
    std::vector<size_t> directives; ///< the `#` of others, if active or `#elseif`
};

/// With `all_known`, only the macros in `known` are predefined; without it, the driver may also define names
/// that begin with GL_.
Preprocessed preprocess(const std::vector<text::Token>& tokens,
                        std::span<const KnownMacro> known = k_site_macros, bool all_known = false);

// Finds the functions that a text defines or declares: return type, parameters with qualifiers, body. Reads
// tokens and never fails; does not see functions that macros define.

struct Parameter {
    std::string_view type;
    std::string_view name; ///< empty if it has none
    bool written = false;  ///< `out`, `inout`
    bool read = true;      ///< not `out`
    bool array = false;
};

/// Numbers are token indices. Only tokens in `Preprocessed::code` are considered.
struct Function {
    std::string_view return_type;
    std::string_view name;
    std::vector<Parameter> parameters;
    size_t type_token = 0; ///< the return type
    size_t name_token = 0;
    size_t open = 0;       ///< (
    size_t close = 0;      ///< )
    size_t body_begin = 0; ///< {; 0 if the function is only declared
    size_t body_end = 0;   ///< its }

    bool defined() const { return body_begin != 0; }
    bool writes_argument() const;
};

/// Returns the functions in text order.
std::vector<Function> find_functions(const std::vector<text::Token>& tokens,
                                     const Preprocessed& preprocessed);

/// Returns the function whose definition contains `token`; nullptr if none does.
const Function* function_around(const std::vector<Function>& functions, size_t token);

// A text prepared for token-based passes: tokens, preprocessor activity, functions. Used by every pass that
// rewrites code and not only names.

/// Kind of line that contains a token.
enum class Place : unsigned char {
    code,
    macro_head, ///< #define or #undef, up to the parameters
    macro_body,
    directive ///< any other directive
};

/// The views stay valid as long as the text does.
struct Reading {
    explicit Reading(std::string_view text);
    Reading(const Reading&) = delete;
    Reading& operator=(const Reading&) = delete;

    std::vector<text::Token> tokens;
    Preprocessed preprocessed;
    std::vector<Function> functions;
    std::vector<Place> places; ///< one entry for each token; inactive tokens count as code
    /// Every macro name with its first definition.
    std::unordered_map<std::string_view, const MacroLine*> macros;

    std::unordered_map<std::string_view, std::vector<const Function*>> overloads; ///< by name

    bool active(size_t token) const { return preprocessed.activity[token] != Activity::inactive; }
    /// Returns whether the text has a function or macro of that name.
    bool defines(std::string_view name) const;
    /// Returns the token that closes the parenthesis, bracket or brace at `open`; `end` if none before `end`
    /// does.
    size_t closing(size_t open, size_t end) const;
    /// Returns whether the tokens at `i` are the two-character operator `two`.
    bool is_pair(size_t i, std::string_view two) const;

private:
    std::vector<size_t> closing_;
};

// Edits of a text by token: several passes may add text before and after a token, or replace it.

class TokenEdits {
public:
    void before(size_t token, std::string_view text) { changes_[token].before += text; }
    void after(size_t token, std::string_view text) { changes_[token].after += text; }
    void replace(size_t token, std::string_view text) { changes_[token].replacement = text; }
    void remove(size_t token) { replace(token, {}); }

    /// Returns edits for MappedText: sorted, without overlap.
    std::vector<text::Edit> edits(const std::vector<text::Token>& tokens) const {
        std::vector<text::Edit> edits;
        for (const auto& [index, change] : changes_) {
            const text::Token& token = tokens[index];
            edits.push_back(
                {token.begin, token.end(),
                 change.before + change.replacement.value_or(std::string(token.text)) + change.after});
        }
        return edits;
    }

private:
    struct Change {
        std::string before;
        std::string after;
        std::optional<std::string> replacement;
    };
    std::map<size_t, Change> changes_;
};

} // namespace tidemark::glsl
