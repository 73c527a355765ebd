#include "shader/builtin_functions.hpp"
#include "shader/promote.hpp"
#include "shader/vocabulary.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <set>
#include <unordered_map>

namespace tidemark::glsl {
namespace {

using text::Token;
using text::TokenKind;

/// A longer function holds a hash among other code, which needs its digits.
constexpr size_t k_longest_hash = 160;
/// A function shorter than this with a sine, a fract and a large number is a hash, however it is written.
constexpr size_t k_short_hash = 70;
/// A sine times this or more keeps only its last digits.
constexpr double k_large_in_fract = 90;
constexpr double k_large_anywhere = 1000;
constexpr double k_large_of_fract = 50; ///< multiple of a fract inside a fract

double literal(const Token& token) {
    if (token.kind != TokenKind::number || token.text.starts_with("0x") || token.text.starts_with("0X"))
        return 0;
    return std::strtod(std::string(token.text).c_str(), nullptr);
}

bool is_sine(const Token& token) {
    return token.is("sin") || token.is("cos") || token.is("tan");
}

class RegionFinder {
public:
    explicit RegionFinder(const Reading& reading) : reading_(reading), tokens_(reading.tokens) {
        for (const auto& [name, macro] : reading_.macros)
            if (!macro->parameters && macro->end == macro->body + 1)
                numbers_[name] = literal(tokens_[macro->body]);
        for (size_t i = 0; i + 5 < tokens_.size(); ++i)
            if (tokens_[i].is("const") && tokens_[i + 3].is("=") && tokens_[i + 5].is(";"))
                numbers_[tokens_[i + 2].text] = literal(tokens_[i + 4]);
    }

    std::vector<FloatRegion> run() {
        if (reading_.defines("fract"))
            return {}; // an author's fract may do anything
        for (const Function& function : reading_.functions)
            if (auto region = whole_function(function))
                found_.push_back(*std::move(region));
        const std::vector<FloatRegion> functions = found_;
        auto next = functions.begin();
        for (size_t i = 0; i < tokens_.size(); ++i) {
            if (next != functions.end() && i >= next->begin) {
                i = next++->end - 1;
                continue;
            }
            if (auto region = expression(i)) {
                i = region->end - 1;
                found_.push_back(*std::move(region));
            }
        }
        std::sort(found_.begin(), found_.end(),
                  [](const auto& a, const auto& b) { return a.begin < b.begin; });
        return std::move(found_);
    }

private:
    /// Returns the value of a literal, or of a macro or constant that is a literal; otherwise 0.
    double value_of(const Token& token) const {
        if (token.kind != TokenKind::identifier)
            return literal(token);
        const auto known = numbers_.find(token.text);
        return known == numbers_.end() ? 0 : known->second;
    }

    bool counts(size_t i) const { return reading_.places[i] == Place::code && reading_.active(i); }
    bool is_call(size_t i, size_t end) const { return i + 1 < end && tokens_[i + 1].is("("); }
    bool is_member(size_t i) const { return i > 0 && tokens_[i - 1].is("."); }

    /// Returns whether the argument of the `fract(…)` at `i` is a large multiple of a sine.
    bool is_sine_hash(size_t i, size_t end) const {
        bool sine = false, large = false;
        for (size_t k = i + 2; k < end; ++k) {
            if (is_sine(tokens_[k]) && is_call(k, end)) {
                sine = true;
                k = reading_.closing(k + 1, end);
            } else {
                large = large || value_of(tokens_[k]) >= k_large_in_fract;
            }
        }
        return sine && large;
    }

    bool is_nested_fract(size_t i, size_t end) const {
        bool inner = false, large = false;
        for (size_t k = i + 2; k < end; ++k) {
            inner = inner || tokens_[k].is("fract");
            large = large || (value_of(tokens_[k]) >= k_large_of_fract && !inner);
        }
        return inner && large;
    }

    /// Returns whether the `fract` at `i` multiplies one variable by itself: `fract(p.x * p.y)`.
    bool is_self_product(size_t i, size_t end) const {
        std::string_view name;
        size_t uses = 0;
        bool product = false;
        for (size_t k = i + 2; k < end; ++k) {
            const Token& token = tokens_[k];
            if (token.is("*")) {
                const Token& left = tokens_[k - 1];
                const Token& right = tokens_[k + 1];
                product = product || ((left.kind == TokenKind::identifier || left.is(")")) &&
                                      (right.kind == TokenKind::identifier || right.is("(")));
            }
            if (token.kind != TokenKind::identifier || is_member(k))
                continue;
            if (!name.empty() && token.text != name)
                return false;
            name = token.text;
            ++uses;
        }
        return product && uses >= 2;
    }

    /// Returns whether `p *= p + …` or `p += dot(p, …)` is at `i`.
    bool is_self_update(size_t i, size_t end) const {
        if (i + 4 >= end || tokens_[i].kind != TokenKind::identifier || !tokens_[i + 2].is("="))
            return false;
        if (tokens_[i + 1].is("*"))
            return tokens_[i + 3].is(tokens_[i].text);
        return tokens_[i + 1].is("+") && tokens_[i + 3].is("dot");
    }

    std::optional<HashKind> kind_of(const Function& function) const {
        const size_t end = function.body_end;
        size_t count = 0, fracts = 0;
        bool sine = false, sine_hash = false, product = false;
        double largest = 0;
        for (size_t i = function.body_begin; i < end; ++i) {
            if (!counts(i))
                continue;
            if (++count > k_longest_hash)
                return std::nullopt;
            sine = sine || (is_sine(tokens_[i]) && is_call(i, end));
            largest = std::max(largest, value_of(tokens_[i]));
            product = product || is_self_update(i, end);
            if (!tokens_[i].is("fract") || !is_call(i, end))
                continue;
            ++fracts;
            const size_t close = reading_.closing(i + 1, end);
            sine_hash = sine_hash || is_sine_hash(i, close);
            product = product || is_self_product(i, close) || is_nested_fract(i, close);
        }
        if (sine_hash || (count < k_short_hash && fracts > 0 && sine && largest >= k_large_anywhere))
            return HashKind::sine;
        if (fracts >= 2 && !sine && product)
            return HashKind::product;
        return std::nullopt;
    }

    std::optional<FloatRegion> whole_function(const Function& function) {
        if (!function.defined() || !is_float_type(function.return_type) || function.writes_argument() ||
            reading_.macros.contains(function.name))
            return std::nullopt;
        std::set<std::string_view> locals;
        for (const Parameter& parameter : function.parameters) {
            if (!value_type(parameter.type) || parameter.array)
                return std::nullopt;
            locals.insert(parameter.name);
        }
        const auto kind = kind_of(function);
        if (!kind || !read_locals(function, locals))
            return std::nullopt;
        FloatRegion region{function.type_token, function.body_end + 1, &function, *kind, {}};
        if (!find_outside(region, function.body_begin, function.body_end, locals))
            return std::nullopt;
        return region;
    }

    /// Adds the variables that the body declares. Returns false if the body has a construct that hashes do
    /// not use.
    bool read_locals(const Function& function, std::set<std::string_view>& locals) const {
        for (size_t i = function.body_begin; i < function.body_end; ++i) {
            const Token& token = tokens_[i];
            if (reading_.places[i] == Place::macro_head || token.is("for") || token.is("while") ||
                token.is("do") || token.is("struct") || token.is("discard") ||
                token.text.starts_with("texture") || token.is("texelFetch"))
                return false;
            if (!value_type(token.text) || tokens_[i + 1].kind != TokenKind::identifier)
                continue;
            int depth = 0;
            for (size_t k = i + 1; k < function.body_end && !tokens_[k].is(";"); ++k) {
                depth += tokens_[k].is("(") || tokens_[k].is("[")   ? 1
                         : tokens_[k].is(")") || tokens_[k].is("]") ? -1
                                                                    : 0;
                if (depth == 0 && tokens_[k].kind == TokenKind::identifier &&
                    (k == i + 1 || tokens_[k - 1].is(",")))
                    locals.insert(tokens_[k].text);
            }
        }
        return true;
    }

    /// Returns a hash that stands alone in an expression or in a macro.
    std::optional<FloatRegion> expression(size_t i) {
        const bool place = reading_.places[i] == Place::code || reading_.places[i] == Place::macro_body;
        if (!place || !reading_.active(i) || !tokens_[i].is("fract") || !is_call(i, tokens_.size()))
            return std::nullopt;
        const size_t close = reading_.closing(i + 1, std::min(tokens_.size(), i + k_longest_hash));
        if (close >= std::min(tokens_.size(), i + k_longest_hash))
            return std::nullopt;
        for (size_t k = i; k < close; ++k)
            if (reading_.places[k] != reading_.places[i] || tokens_[k].text.starts_with("texture"))
                return std::nullopt;
        const bool sine = is_sine_hash(i, close);
        if (!sine && !is_nested_fract(i, close))
            return std::nullopt;
        FloatRegion region{i, close + 1, nullptr, sine ? HashKind::sine : HashKind::product, {}};
        if (!find_outside(region, i, close, {}))
            return std::nullopt;
        return region;
    }

    bool is_own(size_t i, size_t end, const std::set<std::string_view>& locals) const {
        const Token& token = tokens_[i];
        if (is_member(i) || locals.contains(token.text))
            return true;
        if (reading_.macros.contains(token.text))
            return false;
        return is_keyword(token.text) || value_type(token.text) || token.text.starts_with("gl_") ||
               (find_builtin(token.text) && is_call(i, end) && !reading_.defines(token.text));
    }

    /// Finds every variable, macro or function from outside in [begin, end), with its members, indices and
    /// arguments.
    bool find_outside(FloatRegion& region, size_t begin, size_t end,
                      const std::set<std::string_view>& locals) {
        for (size_t i = begin; i < end; ++i) {
            if (tokens_[i].kind != TokenKind::identifier || reading_.places[i] == Place::directive ||
                is_own(i, end, locals))
                continue;
            const auto chain = outside_chain(i, end, region.whole != nullptr);
            if (!chain)
                return false;
            region.outside.push_back(*chain);
            i = chain->second;
        }
        return true;
    }

    std::optional<std::pair<size_t, size_t>> outside_chain(size_t first, size_t end, bool whole) const {
        const auto macro = reading_.macros.find(tokens_[first].text);
        if (macro != reading_.macros.end() && !is_expression(*macro->second))
            return std::nullopt;
        const auto called = reading_.overloads.find(tokens_[first].text);
        if (called != reading_.overloads.end())
            for (const Function* function : called->second)
                if (function->writes_argument())
                    return std::nullopt;
        size_t last = first;
        while (last + 1 < end) {
            const Token& next = tokens_[last + 1];
            if (next.is("(") || next.is("["))
                last = reading_.closing(last + 1, end);
            else if (next.is(".") && last + 2 < end)
                last += 2;
            else
                break;
        }
        if (last >= end || (last + 1 < end && tokens_[last + 1].kind == TokenKind::identifier))
            return std::nullopt;
        const bool steps_first =
            first >= 2 && (reading_.is_pair(first - 2, "++") || reading_.is_pair(first - 2, "--"));
        const bool steps_last = reading_.is_pair(last + 1, "++") || reading_.is_pair(last + 1, "--");
        const bool assigned = is_assignment(last + 1);
        if (whole && (steps_first || steps_last || assigned))
            return std::nullopt; // the caller's variables are doubles
        first -= steps_first ? 2 : 0;
        last += steps_last ? 2 : 0;
        if (assigned)
            last = end_of_assignment(last, end);
        return last < end ? std::optional(std::pair(first, last)) : std::nullopt;
    }

    bool is_expression(const MacroLine& macro) const {
        return macro.body < macro.end &&
               std::none_of(tokens_.begin() + long(macro.body), tokens_.begin() + long(macro.end),
                            [](const Token& t) { return t.is(";") || t.is("{") || t.is("#"); });
    }

    bool is_assignment(size_t i) const {
        if (i + 1 >= tokens_.size())
            return false;
        if (tokens_[i].is("="))
            return !tokens_[i + 1].is("=");
        return tokens_[i].kind == TokenKind::punctuation &&
               std::string_view("+-*/%&|^").find(tokens_[i].text[0]) != std::string_view::npos &&
               tokens_[i + 1].is("=") && tokens_[i + 1].glued;
    }

    size_t end_of_assignment(size_t last, size_t end) const {
        while (last + 1 < end && !tokens_[last + 1].is(",") && !tokens_[last + 1].is(")")) {
            const Token& next = tokens_[last + 1];
            last = next.is("(") || next.is("[") ? reading_.closing(last + 1, end) : last + 1;
        }
        return last;
    }

    const Reading& reading_;
    const std::vector<Token>& tokens_;
    std::unordered_map<std::string_view, double> numbers_; ///< names whose value is a literal
    std::vector<FloatRegion> found_;
};

} // namespace

std::string_view to_string(HashKind kind) {
    switch (kind) {
    case HashKind::sine: return "sine";
    case HashKind::product: return "product";
    case HashKind::bits: return "bits";
    }
    return "";
}

std::vector<FloatRegion> find_float_regions(const Reading& reading) {
    return RegionFinder(reading).run();
}

} // namespace tidemark::glsl
