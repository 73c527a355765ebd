#include "base/tokens.hpp"
#include "lab/scene_numbers.hpp"
#include "lab/study.hpp"
#include "lab/tune.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <set>
#include <span>

namespace tidemark::lab {
namespace {

using text::Token;

using Role = QualitySetting::Role;

/// The properties of a role: its values as factors of the scene's own, from coarse to strict, and parts of
/// names that indicate it.
struct RoleTraits {
    std::string_view does;
    std::array<double, 7> factors;
    double least, most; ///< limits of the scene's own value
    std::vector<std::string_view> words;
};

const RoleTraits& traits(Role role) {
    static const std::array<RoleTraits, 3> k_roles{{
        {"bounds the loop",
         {0.25, 0.375, 0.5, 0.75, 1, 1.5, 2},
         1,
         1e6,
         {"step", "sample", "march", "trace", "taps"}},
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

/// Returns whether `<`, `<=` or their opposites are next to the token.
bool is_compared(std::span<const Token> tokens, size_t at) {
    const auto is = [&](size_t i) { return i < tokens.size() && is_comparison(tokens[i]); };
    return is(at + 1) || is(at - 1) || (at > 1 && tokens[at - 1].is("=") && is(at - 2));
}

bool is_factor(std::span<const Token> tokens, size_t at) {
    return (at > 0 && tokens[at - 1].is("*")) || (at + 1 < tokens.size() && tokens[at + 1].is("*"));
}

/// Returns the index after the bracket that closes the one at `open`.
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

/// A number without a name in the march itself.
struct Literal {
    Use use;
    SourceLocation where;
    std::string text;
};

/// Indices of tokens, from the keyword to the end of the body.
struct Loop {
    size_t begin, head_end, end;
};

/// Finds the uses of numbers in one text.
class Uses {
public:
    Uses(const text::MappedText& text, const std::optional<MarchPlaces>& march,
         const std::set<std::string, std::less<>>& functions)
        : lines_(text.lines()), march_(march), functions_(functions), tokens_(text::tokenize(text.text())) {}

    void find(UsesByName& named, std::vector<Literal>& literals) {
        const std::vector<Loop> loops = find_loops();
        const Loop* const marching = find_marching(loops);
        for (const Loop& loop : loops) {
            const bool marches = marching ? &loop == marching : !march_ && looks_like_march(loop);
            for (size_t i = loop.begin + 2; i < loop.head_end; ++i)
                if (is_compared(tokens_, i))
                    add(i, Role::bound, marches, named, literals);
        }
        for (size_t i = 1; i < tokens_.size(); ++i) {
            if (tokens_[i - 1].is("define"))
                continue;
            const bool in_march = marching && marching->begin < i && i < marching->end;
            if (is_compared(tokens_, i))
                add(i, Role::threshold, march_ && stands_at(i, march_->test), named, literals);
            if (is_factor(tokens_, i))
                add(i, Role::step, in_march && at_step(i), named, literals);
        }
    }

private:
    /// Calls `see(begin, end)` for the statements of a loop's body, without its blocks' brackets.
    template <class See>
    void for_each_statement(const Loop& loop, See see) const {
        size_t begin = loop.head_end;
        for (size_t i = loop.head_end; i < loop.end; ++i)
            if (tokens_[i].is(";") || tokens_[i].is("{") || tokens_[i].is("}")) {
                see(begin, i);
                begin = i + 1;
            }
    }

    bool mentions(size_t begin, size_t end, std::string_view name) const {
        return std::ranges::any_of(std::span(tokens_).subspan(begin, end - begin),
                                   [&](const Token& token) { return token.is(name); });
    }

    bool calls_function(size_t begin, size_t end) const {
        for (size_t i = begin; i + 1 < end; ++i)
            if (tokens_[i + 1].is("(") && functions_.contains(tokens_[i].text))
                return true;
        return false;
    }

    /// Returns whether the loop advances a variable by what a function says, and calls the function with what
    /// depends on that variable: `d = map(ro + t * rd); t += d;`. A sum of octaves does not.
    bool looks_like_march(const Loop& loop) const {
        std::set<std::string_view> answers; // variables that a function's value is stored in
        bool found = false;
        for_each_statement(loop, [&](size_t begin, size_t end) {
            for (size_t i = begin + 1; i + 1 < end; ++i)
                if (tokens_[i].is("=") && tokens_[i - 1].kind == text::TokenKind::identifier &&
                    calls_function(i, end))
                    answers.insert(tokens_[i - 1].text);
        });
        for_each_statement(loop, [&](size_t begin, size_t end) {
            for (size_t i = begin + 1; i + 2 < end; ++i) {
                if (!tokens_[i].is("+") || !tokens_[i + 1].is("=") ||
                    tokens_[i - 1].kind != text::TokenKind::identifier)
                    continue;
                const bool advances =
                    calls_function(i, end) || std::ranges::any_of(answers, [&](std::string_view name) {
                        return mentions(i + 2, end, name);
                    });
                found = found || (advances && is_used_beside(loop, tokens_[i - 1].text, begin, end));
            }
        });
        return found;
    }

    /// Returns whether a statement other than that one uses the variable in a call or to compute another.
    bool is_used_beside(const Loop& loop, std::string_view name, size_t begin, size_t end) const {
        bool used = false;
        for_each_statement(loop, [&](size_t from, size_t to) {
            if (from == begin && to == end)
                return;
            for (size_t i = from + 1; i < to; ++i)
                used = used || (tokens_[i].is(name) && !tokens_[i - 1].is("if") &&
                                (mentions(from, i, "(") || mentions(from, i, "=")) &&
                                (calls_function(from, to) || mentions(from, i, "=")));
        });
        return used;
    }

    bool is_number(size_t at) const { return tokens_[at].kind == text::TokenKind::number; }

    std::vector<Loop> find_loops() const {
        std::vector<Loop> loops;
        for (size_t i = 0; i + 1 < tokens_.size(); ++i) {
            if (!(tokens_[i].is("for") || tokens_[i].is("while")) || !tokens_[i + 1].is("("))
                continue;
            const size_t head_end = behind(tokens_, i + 1);
            const bool block = head_end < tokens_.size() && tokens_[head_end].is("{");
            loops.push_back(
                {i, head_end, std::min(block ? behind(tokens_, head_end) : head_end + 1, tokens_.size())});
        }
        return loops;
    }

    /// Returns the innermost loop around the line of the test.
    const Loop* find_marching(const std::vector<Loop>& loops) const {
        const Loop* found = nullptr;
        for (const Loop& loop : loops)
            if (march_ && surrounds(loop, march_->test) &&
                (!found || loop.end - loop.begin < found->end - found->begin))
                found = &loop;
        return found;
    }

    bool surrounds(const Loop& loop, const SourceLocation& where) const {
        const SourceLocation first = lines_.locate(tokens_[loop.begin].line),
                             last = lines_.locate(tokens_[loop.end - 1].line);
        return first.file == where.file && last.file == where.file && first.line <= where.line &&
               where.line <= last.line;
    }

    bool stands_at(size_t at, const SourceLocation& where) const {
        const SourceLocation here = lines_.locate(tokens_[at].line);
        return here.file == where.file && here.line == where.line;
    }

    bool at_step(size_t at) const {
        return std::ranges::any_of(march_->steps, [&](const auto& step) { return stands_at(at, step); });
    }

    void add(size_t at, Role role, bool march, UsesByName& named, std::vector<Literal>& literals) const {
        const text::Token& token = tokens_[at];
        const Use use{role, lines_.locate(token.line), march};
        if (token.kind == text::TokenKind::identifier)
            named[std::string(token.text)].push_back(use);
        else if (is_number(at) && march)
            literals.push_back({use, lines_.locate(token.line, token.column), std::string(token.text)});
    }

    const text::LineMap& lines_;
    const std::optional<MarchPlaces>& march_;
    const std::set<std::string, std::less<>>& functions_;
    std::vector<Token> tokens_;
};

/// Adds the names of the functions that a text defines.
void add_functions(const text::MappedText& text, std::set<std::string, std::less<>>& names) {
    const auto tokens = text::tokenize(text.text());
    for (size_t i = 1; i + 1 < tokens.size(); ++i)
        if (tokens[i - 1].kind == text::TokenKind::identifier && !tokens[i - 1].is("return") &&
            !tokens[i - 1].is("else") && tokens[i].kind == text::TokenKind::identifier &&
            tokens[i + 1].is("("))
            names.insert(std::string(tokens[i].text));
}

bool speaks_of_any(std::string_view name, const std::vector<std::string_view>& words) {
    return std::ranges::any_of(words, [&](std::string_view word) { return speaks_of(name, {word}); });
}

/// Returns values around the scene's own; nullopt if all of them equal it.
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
    setting.role = use.role;
    setting.why = fmt::format(
        "{} at {}:{}", use.march && use.role == Role::bound ? "bounds the march" : traits(use.role).does,
        use.where.file, use.where.line);
    return setting;
}

/// Returns the setting for a number: by its role in the march, else by its name.
std::optional<QualitySetting> setting_of(const Setting& number, std::vector<Use> uses) {
    std::stable_partition(uses.begin(), uses.end(), [](const Use& use) { return use.march; });
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

/// Returns the setting for the only unnamed number with the role in the scene's own files; if there are
/// several, it is unknown which belongs to the march. The ray's limit is excluded, because it belongs to the
/// picture.
std::optional<QualitySetting> setting_of_the_only(Role role, std::vector<Literal> literals,
                                                  const scene::Scene& scene,
                                                  const std::optional<MarchPlaces>& march) {
    std::erase_if(literals, [&](const Literal& each) {
        const auto value = number_of(each.text);
        return each.use.role != role || !value || *value < traits(role).least || *value > traits(role).most ||
               (march->far && float(*value) == float(*march->far)) ||
               (scene.image().bare_file && each.where.file != scene.file.string());
    });
    const auto elsewhere = [&](const Literal& each) { return !(each.where == literals.front().where); };
    // an include may be part of several texts
    if (literals.empty() || std::ranges::any_of(literals, elsewhere))
        return std::nullopt;
    const Literal& only = literals.front();
    auto setting = around(place_name(only.where), only.text, only.use);
    if (setting)
        setting->why = fmt::format("{}, which {}", only.text,
                                   role == Role::bound ? "bounds the march" : traits(role).does);
    return setting;
}

/// Returns settings for the largest unnamed counts of loops that look like marches, at most two: no march was
/// found by analysis, so that several loops may be one.
std::vector<QualitySetting> longest_marches(std::vector<Literal> literals, const scene::Scene& scene) {
    constexpr size_t k_most = 2;
    constexpr double k_fewest_steps = 12; // shorter loops that advance by a function warp a pattern
    const auto count = [](const Literal& each) { return number_of(each.text).value_or(0); };
    std::erase_if(literals, [&](const Literal& each) {
        return each.use.role != Role::bound || count(each) < k_fewest_steps ||
               count(each) > traits(Role::bound).most ||
               (scene.image().bare_file && each.where.file != scene.file.string());
    });
    std::ranges::stable_sort(literals, std::greater<>(), count);
    std::vector<QualitySetting> found;
    for (const Literal& each : literals) {
        auto setting =
            found.size() < k_most ? around(place_name(each.where), each.text, each.use) : std::nullopt;
        if (!setting)
            continue;
        setting->why = fmt::format("{}, which bounds the march", each.text);
        found.push_back(*std::move(setting));
    }
    return found;
}

/// Returns whether the number does not change the compiled text: it is in a branch of #if that is not taken,
/// for example as the threshold of another solver.
bool is_idle(const QualitySetting& setting, const scene::Scene& scene,
             const std::vector<std::string>& words) {
    const Axis& axis = setting.axis;
    if (is_knob(scene, axis.name))
        return false;
    const auto other = with(scene, {{axis.name, axis.values[setting.own == 0 ? 1 : 0]}});
    return other && compiled_words(*other) == words;
}

} // namespace

QualitySettings quality_settings(const scene::Scene& scene, const std::optional<MarchPlaces>& march) {
    UsesByName uses;
    std::vector<Literal> literals;
    std::set<std::string, std::less<>> functions;
    add_functions(scene.common, functions);
    for (const scene::Pass& pass : scene.passes)
        add_functions(pass.text, functions);
    Uses(scene.common, march, functions).find(uses, literals);
    for (const scene::Pass& pass : scene.passes)
        Uses(pass.text, march, functions).find(uses, literals);
    QualitySettings settings;
    for (const Setting& number : own_numbers(scene)) {
        const std::vector<Use>& of_it = uses[number.name];
        if (auto setting = setting_of(number, of_it))
            settings.found.push_back(*std::move(setting));
        else if (std::ranges::find(of_it, Role::bound, &Use::role) != of_it.end())
            settings.left.push_back(number.name);
    }
    for (const Role role : {Role::bound, Role::threshold, Role::step})
        if (auto setting = setting_of_the_only(role, literals, scene, march))
            settings.found.push_back(*std::move(setting));
    if (!march)
        for (QualitySetting& setting : longest_marches(literals, scene))
            if (std::ranges::find(settings.found, setting.axis.name, [](const QualitySetting& each) {
                    return each.axis.name;
                }) == settings.found.end())
                settings.found.push_back(std::move(setting));
    if (const auto words = compiled_words(scene))
        std::erase_if(settings.found,
                      [&](const QualitySetting& each) { return is_idle(each, scene, *words); });
    return settings;
}

void leave_out_stricter(QualitySetting& setting) {
    std::vector<std::string>& values = setting.axis.values;
    values.resize(std::min(values.size(), setting.own + 1));
}

QualitySetting quality_setting(const scene::Scene& scene, Axis axis) {
    const auto own = std::ranges::find(axis.values, value_of(scene, axis.name));
    const auto at = size_t(own - axis.values.begin());
    return {.axis = std::move(axis), .own = at, .why = "--vary", .march = true};
}

} // namespace tidemark::lab
