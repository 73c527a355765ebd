#include "lab/tune/quality_settings.hpp"

#include "lab/defined_numbers.hpp"
#include "lab/own_numbers.hpp"
#include "lab/study/stricter.hpp"
#include "text/tokens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <span>

namespace tidemark::lab {
namespace {

using text::Token;

enum class Role { bound, threshold, step };

/// What a role takes: its values as factors of the scene's own from coarse to strict, and names that are
/// certain to mean it.
struct RoleTraits {
    std::string_view does;
    std::array<double, 7> factors;
    double least, most; ///< of the scene's own value
    std::vector<std::string_view> words;
};

const RoleTraits& traits(Role role) {
    static const std::array<RoleTraits, 3> k_roles{{
        {"bounds the loop",
         {0.25, 0.375, 0.5, 0.75, 1, 1.5, 2},
         1,
         1e6,
         {"step", "iter", "octave", "sample", "march", "trace", "turn", "taps", "quality", "detail",
          "bounce"}},
        {"is the threshold",
         {32, 8, 4, 2, 1, 0.5, 0.25},
         1e-7,
         0.1,
         {"eps", "precis", "tolerance", "thresh", "hit", "surf", "min_dist", "mindist", "accura"}},
        {"scales the step",
         {2, 1.5, 1.25, 1.1, 1, 0.8, 0.5},
         0.01,
         1.6,
         {"step", "relax", "omega", "overshoot", "march", "safety", "lipschitz"}},
    }};
    return k_roles[size_t(role)];
}

struct Use {
    Role role;
    SourceLocation where{};
    bool march = false;
};

using UsesByName = std::map<std::string, std::vector<Use>>;

bool is_comparison(const Token& token) {
    return token.is("<") || token.is(">");
}

/// `<`, `<=` and their kind directly beside the token.
bool is_compared(std::span<const Token> tokens, size_t at) {
    const auto is = [&](size_t i) { return i < tokens.size() && is_comparison(tokens[i]); };
    return is(at + 1) || is(at - 1) || (at > 1 && tokens[at - 1].is("=") && is(at - 2));
}

bool is_factor(std::span<const Token> tokens, size_t at) {
    return (at > 0 && tokens[at - 1].is("*")) || (at + 1 < tokens.size() && tokens[at + 1].is("*"));
}

/// The token behind the bracket that closes the one at `open`.
size_t behind(std::span<const Token> tokens, size_t open) {
    int depth = 0;
    for (size_t i = open; i < tokens.size(); ++i) {
        depth += tokens[i].is("(") || tokens[i].is("{");
        depth -= tokens[i].is(")") || tokens[i].is("}");
        if (depth == 0)
            return i + 1;
    }
    return tokens.size();
}

/// Where numbers are used in one text.
class Uses {
public:
    Uses(const text::MappedText& text, const std::optional<SourceLocation>& march, UsesByName& found)
        : lines_(text.lines()), march_(march), tokens_(text::tokenize(text.text())), found_(found) {}

    void find() {
        for (size_t i = 1; i < tokens_.size(); ++i) {
            if (tokens_[i].is("for") || tokens_[i].is("while"))
                look_at_head(i);
            if (tokens_[i].kind != text::TokenKind::identifier || tokens_[i - 1].is("define"))
                continue;
            if (is_compared(tokens_, i))
                add(i, Role::threshold, at_march(tokens_[i].line, tokens_[i].line));
            if (is_factor(tokens_, i))
                add(i, Role::step, false);
        }
    }

private:
    /// A name that a loop's condition compares bounds it.
    void look_at_head(size_t loop) {
        if (loop + 1 >= tokens_.size() || !tokens_[loop + 1].is("("))
            return;
        const size_t head_end = behind(tokens_, loop + 1);
        const size_t end =
            head_end < tokens_.size() && tokens_[head_end].is("{") ? behind(tokens_, head_end) : head_end + 1;
        const int last_line = tokens_[std::min(end, tokens_.size()) - 1].line;
        for (size_t i = loop + 2; i < head_end; ++i)
            if (tokens_[i].kind == text::TokenKind::identifier && is_compared(tokens_, i))
                add(i, Role::bound, at_march(tokens_[loop].line, last_line));
    }

    bool at_march(int first_line, int last_line) const {
        if (!march_)
            return false;
        const SourceLocation first = lines_.locate(first_line), last = lines_.locate(last_line);
        return first.file == march_->file && last.file == march_->file && first.line <= march_->line &&
               march_->line <= last.line;
    }

    void add(size_t at, Role role, bool march) {
        found_[std::string(tokens_[at].text)].push_back({role, lines_.locate(tokens_[at].line), march});
    }

    const text::LineMap& lines_;
    const std::optional<SourceLocation>& march_;
    std::vector<Token> tokens_;
    UsesByName& found_;
};

bool speaks_of_any(std::string_view name, const std::vector<std::string_view>& words) {
    return std::ranges::any_of(words, [&](std::string_view word) { return speaks_of(name, {word}); });
}

/// Values around the scene's own; nothing where there are none but that.
std::optional<QualitySetting> around(const std::string& name, const std::string& own, const Use& use) {
    QualitySetting setting;
    setting.axis.name = name;
    for (const double factor : traits(use.role).factors) {
        const auto value = factor == 1 ? own : scaled(own, factor);
        if (!value || std::ranges::find(setting.axis.values, *value) != setting.axis.values.end())
            continue;
        if (factor == 1)
            setting.own = setting.axis.values.size();
        else if (*value == own)
            continue;
        setting.axis.values.push_back(*value);
    }
    if (setting.axis.values.size() < 2)
        return std::nullopt;
    setting.march = use.march;
    setting.why = fmt::format(
        "{} at {}:{}", use.march && use.role == Role::bound ? "bounds the march" : traits(use.role).does,
        use.where.file, use.where.line);
    return setting;
}

/// What a number may be turned as: as what the march has it for, or else as what it is called.
std::optional<QualitySetting> setting_of(const Setting& number, std::vector<Use> uses) {
    std::ranges::stable_partition(uses, &Use::march);
    const auto value = number_of(number.value);
    for (const Use& use : uses) {
        const RoleTraits& role = traits(use.role);
        if (!value || *value < role.least || *value > role.most ||
            !(use.march || speaks_of_any(number.name, role.words)))
            continue;
        if (auto setting = around(number.name, number.value, use))
            return setting;
    }
    return std::nullopt;
}

} // namespace

QualitySettings quality_settings(const scene::Scene& scene, const std::optional<SourceLocation>& march) {
    UsesByName uses;
    Uses(scene.common, march, uses).find();
    for (const scene::Pass& pass : scene.passes)
        Uses(pass.text, march, uses).find();
    QualitySettings settings;
    for (const Setting& number : own_numbers(scene)) {
        const std::vector<Use>& of_it = uses[number.name];
        if (auto setting = setting_of(number, of_it))
            settings.found.push_back(*std::move(setting));
        else if (std::ranges::find(of_it, Role::bound, &Use::role) != of_it.end())
            settings.left.push_back(number.name);
    }
    return settings;
}

QualitySetting quality_setting(const scene::Scene& scene, Axis axis) {
    const auto own = std::ranges::find(axis.values, value_of(scene, axis.name));
    const auto at = size_t(own - axis.values.begin());
    return {.axis = std::move(axis), .own = at, .why = "--vary", .march = true};
}

} // namespace tidemark::lab
