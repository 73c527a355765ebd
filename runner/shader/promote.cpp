// Finds constants that a promoted text must declare without `const`: a call of a function that is not GLSL's
// own is not a constant expression.

#include "shader/promote.hpp"

#include "shader/builtin_functions.hpp"
#include "shader/double_functions.hpp"
#include "shader/token_reading.hpp"
#include "shader/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace tidemark::glsl {

namespace {

using text::Token;
using text::TokenKind;

/// Limit of the passes over the lists: macros may name constants and constants macros, each defined after its
/// use.
constexpr int k_most_rounds = 6;

class LossFinder {
public:
    LossFinder(const Reading& reading, const std::function<bool(std::string_view)>& replaced)
        : reading_(reading), replaced_(replaced) {}

    std::vector<size_t> run() {
        for (int round = 0; round < k_most_rounds; ++round) {
            const size_t known = lost_names_.size();
            lost_.clear();
            for (const MacroLine& macro : reading_.preprocessed.macros)
                if (is_lost(macro.body, macro.end))
                    lost_names_.insert(macro.name);
            const std::vector<size_t>& code = reading_.preprocessed.code;
            for (size_t at = 0; at < code.size(); ++at)
                if (token(at).is("const") && at + 1 < code.size() && !is_parameter(at))
                    at = read_declaration(at);
            if (lost_names_.size() == known)
                break;
        }
        return std::move(lost_);
    }

private:
    const Token& token(size_t at) const { return reading_.tokens[reading_.preprocessed.code[at]]; }

    bool is_parameter(size_t at) const {
        return at > 0 && (token(at - 1).is("(") || token(at - 1).is(",") || token(at - 1).is("in"));
    }

    bool is_lost(const Token& word) const {
        return word.kind == TokenKind::identifier &&
               (lost_names_.contains(word.text) || replaced_(word.text));
    }

    bool is_lost(size_t begin, size_t end) const {
        for (size_t i = begin; i < end; ++i)
            if (is_lost(reading_.tokens[i]))
                return true;
        return false;
    }

    /// Reads `const T a = …, b = …;` at `at`: one lost value makes all its names lost. Returns the
    /// declaration's end.
    size_t read_declaration(size_t at) {
        std::vector<std::string_view> names;
        bool lost = false, value = false;
        int depth = 0;
        size_t i = at + 1;
        for (; i < reading_.preprocessed.code.size() && !token(i).is(";") && depth >= 0; ++i) {
            const Token& word = token(i);
            depth += nesting(word.text);
            if (depth == 0 && word.is(","))
                value = false;
            else if (depth == 0 && word.is("="))
                value = true;
            else if (value)
                lost = lost || is_lost(word);
            else if (depth == 0 && word.kind == TokenKind::identifier)
                names.push_back(word.text);
        }
        if (lost) {
            lost_.push_back(reading_.preprocessed.code[at]);
            lost_names_.insert(names.begin(), names.end());
        }
        return i;
    }

    const Reading& reading_;
    const std::function<bool(std::string_view)>& replaced_;
    std::unordered_set<std::string_view> lost_names_;
    std::vector<size_t> lost_;
};

} // namespace

/// Returns the token of each `const` in a declaration whose value calls a function that `replaced` accepts,
/// directly or through macros and other constants.
std::vector<size_t> find_lost_constants(const Reading& reading,
                                        const std::function<bool(std::string_view)>& replaced) {
    return LossFinder(reading, replaced).run();
}

namespace {

using text::Token;
using text::TokenKind;

constexpr std::string_view k_single = "tidemark_single";
constexpr std::string_view k_float_copy = "tidemark_float_"; ///< prefix of a hash function's name
constexpr std::string_view k_inner_main = "tidemark_promoted_main";
constexpr std::string_view k_outputs = "tidemark_output";

constexpr std::string_view k_without_double[] = {"gl_FragDepth", "interpolateAtCentroid",
                                                 "interpolateAtOffset", "interpolateAtSample"};

/// Returns whether the token names a double type. If a text defines such a macro, it means something else,
/// and the macro is renamed so that it does not reach our own lines.
bool is_double_word(std::string_view word) {
    return word == "double" || !float_type_of(word).empty();
}

/// Maps `dFdxFine` to `dFdx`: fine and coarse derivatives may be the same.
std::string_view canonical(std::string_view name) {
    if (name.starts_with("dFd") || name.starts_with("fwidth"))
        for (const std::string_view variant : {"Fine", "Coarse"})
            if (name.ends_with(variant))
                name.remove_suffix(variant.size());
    return name;
}

/// Returns whether some overload takes a float as the argument of that number.
bool takes_floats(const BuiltinFunction& function, size_t argument) {
    return std::ranges::any_of(overloads_of(function), [&](const BuiltinOverload& overload) {
        return argument < overload.parameters.size() && is_float_type(overload.parameters[argument].type);
    });
}

bool is_float_literal(const Token& token) {
    const auto type = token.kind == TokenKind::number ? type_of_literal(token.text) : std::nullopt;
    return type && type->base == 'f';
}

class Promoter {
public:
    Promoter(text::MappedText body, bool hashes_too)
        : body_(std::move(body)), reading_(body_.text()), tokens_(reading_.tokens),
          settled_(tokens_.size(), false), hashes_too_(hashes_too) {}

    Result<Promoted> run() {
        if (!hashes_too_)
            for (const FloatRegion& region : find_float_regions(reading_))
                keep(region);
        for (const size_t constant : find_lost_constants(
                 reading_, [](std::string_view name) { return is_replaced(canonical(name)); }))
            edits_.remove(constant);
        for (size_t i = 0; i < tokens_.size(); ++i)
            promote_token(i);
        promote_interface();
        wrap_main();
        if (error_)
            return fail(*std::move(error_));
        std::sort(hashes_.begin(), hashes_.end(), [](const auto& a, const auto& b) {
            return std::tie(a.where.file, a.where.line) < std::tie(b.where.file, b.where.line);
        });
        Promoted result{double_functions(used_, own_signatures()), {}, std::move(hashes_)};
        const std::vector<text::Edit> edits = edits_.edits(tokens_);
        body_.apply(edits);
        result.body = std::move(body_);
        return result;
    }

private:
    SourceLocation where(size_t i) const { return body_.lines().locate(tokens_[i].line, tokens_[i].column); }
    bool is_ours(size_t i) const { return body_.lines().locate(tokens_[i].line).file.empty(); }

    void refuse(size_t i, const std::string& what) {
        if (!error_)
            error_ = error_at(where(i), what);
    }

    // Hashes that stay in floats

    void keep(const FloatRegion& region) {
        std::fill(settled_.begin() + long(region.begin), settled_.begin() + long(region.end), true);
        for (const auto& [first, last] : region.outside) {
            std::fill(settled_.begin() + long(first), settled_.begin() + long(last) + 1, false);
            edits_.before(first, fmt::format("{}(", k_single));
            edits_.after(last, ")");
            used_.insert("single");
        }
        if (region.whole)
            keep_function(*region.whole);
        const size_t place = region.whole ? region.whole->name_token : region.begin;
        hashes_.push_back({owner_of(place), where(place), region.kind});
        hashes_.back().where.column = 0;
    }

    /// Renames the function, and adds one of its name after it that calls it with floats.
    void keep_function(const Function& function) {
        std::string declared, passed;
        for (const Parameter& parameter : function.parameters) {
            const bool floats = is_float_type(parameter.type);
            const char* comma = declared.empty() ? "" : ", ";
            const std::string name = fmt::format("a{}", &parameter - function.parameters.data());
            declared += fmt::format("{}{} {}", comma, double_type_of(parameter.type), name);
            passed += floats ? fmt::format("{}{}({})", comma, parameter.type, name) : comma + name;
        }
        edits_.replace(function.name_token, fmt::format("{}{}", k_float_copy, function.name));
        edits_.after(function.body_end,
                     fmt::format(" {} {}({}) {{ return {}{}({}); }}", double_type_of(function.return_type),
                                 renamed(function.name), declared, k_float_copy, function.name, passed));
    }

    std::string owner_of(size_t token) const {
        if (const Function* function = function_around(reading_.functions, token))
            return std::string(function->name);
        const std::vector<MacroLine>& macros = reading_.preprocessed.macros;
        const auto next =
            std::upper_bound(macros.begin(), macros.end(), token,
                             [](size_t wanted, const MacroLine& each) { return wanted < each.hash; });
        if (reading_.places[token] == Place::macro_body && next != macros.begin())
            return std::string(std::prev(next)->name);
        return {};
    }

    // Tokens

    static std::string renamed(std::string_view name) {
        return is_replaced(canonical(name)) ? fmt::format("{}{}", k_ours, canonical(name))
                                            : std::string(name);
    }

    void promote_token(size_t i) {
        const Token& token = tokens_[i];
        const Place place = reading_.places[i];
        if (settled_[i])
            return note_bits(i);
        if (token.kind == TokenKind::identifier && is_replaced(canonical(token.text)))
            return promote_call(i);
        if (is_double_word(token.text) && reading_.macros.contains(token.text))
            return edits_.replace(i, fmt::format("st_{}", token.text));
        if (place == Place::directive || place == Place::macro_head)
            return;
        if (is_float_literal(token))
            promote_literal(i);
        else if (token.kind == TokenKind::identifier)
            promote_word(i);
    }

    void note_bits(size_t i) {
        const bool bits = tokens_[i].is("floatBitsToUint") || tokens_[i].is("floatBitsToInt");
        if (!bits || !reading_.active(i) || is_ours(i) || reading_.defines(tokens_[i].text))
            return;
        hashes_.push_back({owner_of(i), where(i), HashKind::bits});
        hashes_.back().where.column = 0;
    }

    void promote_call(size_t i) {
        edits_.replace(i, renamed(tokens_[i].text));
        if (reading_.active(i))
            used_.insert(canonical(tokens_[i].text));
        note_bits(i);
    }

    /// Returns whether the token is next to `##`, and so only a part of a name.
    bool is_pasted(size_t i) const {
        return (i > 0 && tokens_[i - 1].is("#")) ||
               (i + 1 < tokens_.size() && tokens_[i + 1].is("#") && !tokens_[i + 1].first_on_line);
    }

    void promote_literal(size_t i) {
        std::string_view digits = tokens_[i].text;
        if (reading_.places[i] == Place::macro_body && is_pasted(i))
            return;
        while (digits.ends_with('f') || digits.ends_with('F'))
            digits.remove_suffix(1);
        edits_.replace(i, fmt::format("{}lf", digits));
    }

    void promote_word(size_t i) {
        const Token& token = tokens_[i];
        if (is_float_type(token.text))
            edits_.replace(i, double_type_of(token.text));
        else if ((token.is("vec") || token.is("mat")) && reading_.places[i] == Place::macro_body &&
                 is_pasted(i))
            edits_.replace(i, fmt::format("d{}", token.text));
        else if (is_precision(token.text))
            edits_.remove(i);
        else if (token.is("precision"))
            remove_precision(i);
        else if ((token.is("gl_FragCoord") || token.is("gl_PointCoord")) &&
                 (is_ours(i) || !reading_.macros.contains(token.text)))
            edits_.replace(i,
                           fmt::format("{}({})", token.is("gl_FragCoord") ? "dvec4" : "dvec2", token.text));
        else if (reading_.active(i))
            promote_special(i);
    }

    /// Removes `precision highp float;`.
    void remove_precision(size_t i) {
        for (const size_t end = std::min(i + 4, tokens_.size()); i < end; ++i) {
            edits_.remove(i);
            settled_[i] = true;
            if (tokens_[i].is(";"))
                return;
        }
    }

    void promote_special(size_t i) {
        const std::string_view name = tokens_[i].text;
        if (is_one_of(name, k_without_double) && !reading_.defines(name))
            return refuse(i, fmt::format("'{}' has no form in double precision", name));
        const bool sampler =
            name.starts_with("sampler") || name.starts_with("isampler") || name.starts_with("usampler");
        const bool known =
            name == "sampler" || name == "sampler2D" || name == "sampler3D" || name == "samplerCube";
        if (sampler && !known && reading_.places[i] == Place::code && i + 1 < tokens_.size() &&
            tokens_[i + 1].kind == TokenKind::identifier)
            return refuse(i, fmt::format("lookups of a '{}' have no form in double precision", name));
        const BuiltinFunction* const function = find_builtin(name);
        if (function && takes_constants(*function) && !reading_.defines(name) && i + 1 < tokens_.size() &&
            tokens_[i + 1].is("("))
            wrap_call(i, *function);
    }

    /// Wraps a look-up in place, because its offset or component must stay a constant in the text.
    void wrap_call(size_t i, const BuiltinFunction& function) {
        const size_t close = reading_.closing(i + 1, tokens_.size());
        if (close >= tokens_.size())
            return;
        edits_.before(i, "dvec4(");
        size_t first = i + 2;
        for (size_t argument = 0; first <= close; ++argument) {
            size_t end = first;
            while (end < close && !tokens_[end].is(","))
                end = 1 + (tokens_[end].is("(") || tokens_[end].is("[") ? reading_.closing(end, close) : end);
            if (takes_floats(function, argument) && end > first) {
                edits_.before(first, fmt::format("{}(", k_single));
                edits_.after(end - 1, ")");
                used_.insert("single");
            }
            first = end + 1;
        }
        edits_.after(close, ")");
    }

    // Inputs and outputs

    /// Promotes global `in` and `out`. A fragment shader here gets no inputs, so an input becomes an ordinary
    /// variable. An output becomes a double of its name and a float that is set at the end of main.
    void promote_interface() {
        const std::vector<size_t>& code = reading_.preprocessed.code;
        int depth = 0;
        for (size_t at = 0; at < code.size(); ++at) {
            const Token& token = tokens_[code[at]];
            depth += token.is("{") || token.is("(") ? 1 : token.is("}") || token.is(")") ? -1 : 0;
            if (depth != 0)
                continue;
            if (token.is("varying") || token.is("attribute") || token.is("in") || token.is("flat") ||
                token.is("smooth") || token.is("centroid") || token.is("noperspective"))
                edits_.remove(code[at]);
            else if (token.is("out"))
                promote_output(at);
        }
    }

    void promote_output(size_t at) {
        const std::vector<size_t>& code = reading_.preprocessed.code;
        size_t type = at + 1;
        while (type < code.size() && is_precision(tokens_[code[type]].text))
            ++type;
        if (type + 2 >= code.size() || !is_float_type(tokens_[code[type]].text))
            return;
        const Token& name = tokens_[code[type + 1]];
        if (name.kind != TokenKind::identifier || !tokens_[code[type + 2]].is(";"))
            return refuse(code[at],
                          "an 'out' in double precision must be one variable: split the declaration");
        const std::string_view plain = tokens_[code[type]].text;
        const std::string output = fmt::format("{}{}", k_outputs, outputs_.size());
        edits_.replace(code[type], plain);
        edits_.replace(code[type + 1], output);
        edits_.after(code[type + 2], fmt::format(" {} {};", double_type_of(plain), name.text));
        outputs_.push_back(fmt::format(" {} = {}({});", output, plain, name.text));
    }

    /// Wraps our own `main`, or the author's if there is no other.
    void wrap_main() {
        const Function* chosen = nullptr;
        for (const Function& function : reading_.functions)
            if (function.name == "main" && function.defined() && function.parameters.empty() &&
                (!chosen || is_ours(function.name_token)))
                chosen = &function;
        if (!chosen || outputs_.empty())
            return;
        edits_.replace(chosen->name_token, k_inner_main);
        std::string text = fmt::format(" void main() {{ {}();", k_inner_main);
        for (const std::string& output : outputs_)
            text += output;
        edits_.after(chosen->body_end, text + " }");
    }

    Signatures own_signatures() const {
        Signatures own;
        for (const Function& function : reading_.functions) {
            if (!is_replaced(function.name))
                continue;
            std::string types;
            for (const Parameter& parameter : function.parameters)
                types += (types.empty() ? "" : ",") + double_type_of(parameter.type);
            own.emplace(function.name, types);
        }
        return own;
    }

    text::MappedText body_;
    Reading reading_;
    const std::vector<Token>& tokens_;
    TokenEdits edits_;
    std::vector<bool> settled_; ///< tokens that are not changed any more
    bool hashes_too_;
    std::set<std::string_view> used_;
    std::vector<std::string> outputs_; ///< assignments at the end of main
    std::vector<KeptHash> hashes_;
    std::optional<Error> error_;
};

} // namespace

Result<Promoted> promote(text::MappedText body, bool hashes_too) {
    return Promoter(std::move(body), hashes_too).run();
}

} // namespace tidemark::glsl
