#include "shader/builtin_functions.hpp"
#include "shader/cuts.hpp"
#include "shader/loops.hpp"
#include "shader/parsed_text.hpp"
#include "shader/uniform_expressions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace tidemark::glsl {
namespace {

constexpr double k_unknown_turns = 16, k_texture = 8, k_costly = 4;
/// Upper limit of an estimate; recursion or nested loops would make it infinite.
constexpr double k_most = 1e12;

double turns_of(const ParsedText& text, NodeId loop) {
    const auto bound = loop_bound(text, loop);
    return bound && bound->number != k_no_node ? std::max(1.0, bound->turns) : k_unknown_turns;
}

/// Returns the weight of one operation or built-in function; 0 for all else.
double weight_of(const ParsedText& text, NodeId id) {
    switch (text.tree()[id].kind) {
    case NodeKind::prefix:
    case NodeKind::postfix:
    case NodeKind::binary:
    case NodeKind::assign:
    case NodeKind::conditional: return 1;
    case NodeKind::call: {
        const std::string_view name = called_name(text, id);
        const BuiltinFunction* const function = find_builtin(name);
        return !function                     ? 0
               : name.starts_with("tex")     ? k_texture
               : function->is(Trait::costly) ? k_costly
                                             : 1;
    }
    default: return 0;
    }
}

} // namespace

WorkEstimate::WorkEstimate(const ParsedText& text, const TreeFacts& facts)
    : text_(text), tree_(text.tree()), facts_(facts), once_(tree_.nodes.size()), times_(tree_.nodes.size()) {
    add_up();
    add_up(); // functions called before their definition are known now
    count_times();
}

double WorkEstimate::own(NodeId id) const {
    if (tree_[id].kind == NodeKind::call)
        if (const auto known = functions_.find(called_name(text_, id)); known != functions_.end())
            return known->second;
    return weight_of(text_, id);
}

/// Sums bottom-up: children come before their parents.
void WorkEstimate::add_up() {
    for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
        double sum = own(id);
        for (NodeId child = tree_[id].first_child; child != k_no_node; child = tree_[child].next)
            sum += once_[child];
        once_[id] = std::min(k_most, is_loop(tree_[id].kind) ? sum * turns_of(text_, id) : sum);
        if (tree_[id].kind == NodeKind::function)
            functions_[text_.word_of(id)] = std::max(functions_[text_.word_of(id)], once_[id]);
    }
}

/// Counts how often each node runs in one call of its function, then how often each function is called.
void WorkEstimate::count_times() {
    std::unordered_map<std::string_view, std::vector<NodeId>> sites; // by the name that is called
    for (NodeId id = NodeId(tree_.nodes.size()) - 1; id > 0; --id) {
        const NodeId parent = tree_[id].parent;
        const bool inside = parent != k_no_node && tree_[id].kind != NodeKind::function;
        times_[id] =
            !inside ? 1 : times_[parent] * (is_loop(tree_[parent].kind) ? turns_of(text_, parent) : 1);
        if (calls_authors_function(text_, facts_, id))
            sites[called_name(text_, id)].push_back(id);
    }
    std::unordered_map<std::string_view, double> calls{{"main", 1.0}};
    const std::function<double(NodeId)> calls_of = [&](NodeId function) {
        const std::string_view name = function == k_no_node ? "" : text_.word_of(function);
        const auto [known, fresh] = calls.emplace(name, 0.0); // stays 0 for a recursive call
        if (!fresh)
            return known->second;
        double sum = 0;
        for (const NodeId site : sites[name])
            sum += times_[site] * calls_of(tree_.around(site, NodeKind::function));
        return calls[name] = std::min(k_most, sum);
    };
    std::vector<double> in_all(times_.size());
    for (NodeId id = 1; id < tree_.nodes.size(); ++id)
        in_all[id] = times_[id] * calls_of(tree_.around(id, NodeKind::function));
    times_ = std::move(in_all);
}

namespace {

/// Share of the buffer's pixels that are no longer drawn.
constexpr double k_saved = 0.75;

bool says(const ParsedText& text, std::string_view name) {
    for (size_t i = 0; i < text.words().size(); ++i)
        if (text.word(i) == name && !text.used(i).file.empty())
            return true;
    return false;
}

/// Returns the files that belong to more than one pass.
std::set<std::string> shared_files(std::span<const BufferReader> passes) {
    std::map<std::string, size_t> owners;
    std::set<std::string> shared;
    for (size_t pass = 0; pass < passes.size(); ++pass)
        for (size_t i = 0; i < passes[pass].text.words().size(); ++i) {
            const std::string file = passes[pass].text.used(i).file;
            if (!file.empty() && owners.try_emplace(file, pass).first->second != pass)
                shared.insert(file);
        }
    return shared;
}

/// Collects the edits that redirect one sampler's look-ups to the buffer's drawn quarter. A repeating sampler
/// would mix in the opposite edge, so its look-ups stay half a pixel away from the edge.
class LookUps {
public:
    LookUps(const BufferReader& reader, const BufferSampler& sampler)
        : text_(reader.text), tree_(text_.tree()), facts_(reader.facts), sampler_(sampler) {}

    /// Returns nothing if a look-up cannot be redirected.
    std::optional<std::vector<Wrap>> run() {
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
            const bool named = tree_[id].kind == NodeKind::name && text_.word_of(id) == sampler_.name &&
                               !text_.used(tree_[id].word).file.empty();
            if (named && !lead(id))
                return std::nullopt;
        }
        return std::move(wraps_);
    }

private:
    bool lead(NodeId sampler) {
        const NodeId call = tree_[sampler].parent;
        if (tree_[call].kind != NodeKind::call || tree_.child_count(call) < 3 ||
            tree_.child(call, 1) != sampler || facts_.function(called_name(text_, call)))
            return false;
        const auto said = written_for(text_, sampler, call);
        const auto place = written_for(text_, tree_.child(call, 2), call);
        // A macro that takes its sampler as an argument would redirect the look-ups of other samplers, too.
        if (!said || !place || text_.tokens()[said->first].text != sampler_.name)
            return false;
        const std::string_view name = called_name(text_, call);
        const size_t operands = tree_.child_count(call) - 1;
        if ((name == "texture" && operands == 2) || (name == "textureLod" && operands == 3))
            add(sampler_.repeats ? wrapped(text_, *place, "max(0.5 * fract(", "), 0.5 / iResolution.xy)")
                                 : wrapped(text_, *place, "0.5 * clamp(", ", 0.0, 1.0)"));
        else if (name == "texelFetch" && operands == 3)
            return lead_fetch(call, *place);
        else
            return false;
        return true;
    }

    /// Redirects a fetch of one pixel to a filtered look-up: the pixel's centre now lies between four drawn
    /// pixels.
    bool lead_fetch(NodeId call, WrittenTokens place) {
        const auto whole = written_for(text_, call, call);
        const auto level = written_for(text_, tree_.child(call, 3), call);
        if (!whole || !level || level->first != level->last || text_.tokens()[level->first].text != "0" ||
            text_.tokens()[whole->first].text != "texelFetch")
            return false;
        add(in_place_of(text_, {whole->first, whole->first}, "textureLod"));
        add(wrapped(text_, place, "max(0.5 * (vec2(", ") + 0.5), 0.5) / iResolution.xy"));
        add(in_place_of(text_, *level, "0.0"));
        return true;
    }

    /// Adds an edit once: a macro's body is written once, however often it is used.
    void add(Wrap wrap) {
        if (std::ranges::find(wraps_, wrap) == wraps_.end())
            wraps_.push_back(std::move(wrap));
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    const BufferSampler& sampler_;
    std::vector<Wrap> wraps_{};
};

/// Draws half of both dimensions and one pixel more, which look-ups at the edge mix in.
std::optional<Wrap> drawn_small(const ParsedText& text, NodeId main) {
    const std::vector<NodeId> parameters = parameters_of(text, main);
    if (parameters.size() != 2 || has_qualifier(text, text.tree().child(parameters[1], 0), "const"))
        return std::nullopt;
    const std::string_view colour = text.word_of(parameters[0]), place = text.word_of(parameters[1]);
    return at_word(text, text.tree()[body_of_function(text, main)].begin, "",
                   fmt::format(" if (any(greaterThan({1}, 0.5 * iResolution.xy + 1.0))) {{ {0} = "
                               "vec4(0.0); return; }} {1} *= 2.0;",
                               colour, place));
}

constexpr size_t k_longest = 160, k_most_values = 64;

struct SharedValue {
    std::string type, name, words;
};

class CutFinder {
public:
    CutFinder(const ParsedText& text, const TreeFacts& facts, const WorkEstimate& work)
        : text_(text), tree_(text.tree()), facts_(facts), work_(work), globals_(find_globals(text)),
          expressions_(text, globals_), edits_(text) {}

    std::optional<Cut> run() {
        if (!find_main() || runs_without_main())
            return std::nullopt;
        for (const Global& global : globals_)
            if (tree_[global.node].kind == NodeKind::function && global.node <= main_)
                look_at(global);
        return values_.empty() ? std::nullopt : cut();
    }

private:
    std::string file_of(NodeId id) const { return text_.used(tree_[id].begin).file; }

    bool find_main() {
        main_ = find_main_image(text_);
        if (main_ == k_no_node)
            return false;
        for (const NodeId parameter : parameters_of(text_, main_))
            parameters_.push_back(text_.word_of(parameter));
        return true;
    }

    /// Returns whether code runs before mainImage (a global's initialiser) or instead of it (mainHit).
    bool runs_without_main() const {
        const bool hits =
            std::ranges::any_of(text_.tokens(), [](const text::Token& token) { return token.is("mainHit"); });
        bool first = false;
        for (NodeId id = 1; id < tree_.nodes.size(); ++id)
            first = first || (calls_authors_function(text_, facts_, id) &&
                              tree_.around(id, NodeKind::function) == k_no_node);
        return hits || first;
    }

    void look_at(const Global& function) {
        const Word& begin = text_.words()[tree_[function.node].begin];
        if (begin.from_macro() || file_of(function.node) != file_of(main_))
            return;
        expressions_.enter(function);
        std::vector<std::pair<NodeId, std::string>> taken;
        for (NodeId id = function.node; id >= function.first; --id) { // parents first
            const auto words = is_worth_it(id) ? said_in_main(id) : std::nullopt;
            if (!words)
                continue;
            taken.emplace_back(id, *words);
            while (tree_[id].first_child != k_no_node)
                id = tree_[id].first_child;
        }
        for (auto each = taken.rbegin(); each != taken.rend() && values_.size() < k_most_values; ++each)
            take(each->first, each->second, function.node);
    }

    bool is_worth_it(NodeId id) const {
        if (!is_expression(tree_[id].kind))
            return false;
        const auto value = expressions_.value(id);
        return value && value->uniform && value->costly && work_.of(id) >= 2 * work_.once(id) &&
               work_.once(id) > 0 && edits_.stands_alone(tree_[id].begin, tree_[id].end);
    }

    void take(NodeId id, const std::string& words, NodeId function) {
        const std::string type = to_string(expressions_.value(id)->type);
        auto known = std::ranges::find_if(
            values_, [&](const SharedValue& value) { return value.type == type && value.words == words; });
        if (known == values_.end())
            known = values_.insert(known, {type, next_name(), words});
        const auto [first, last] = edits_.tokens_of(tree_[id].begin, tree_[id].end);
        uses_.push_back(in_place_of(text_, {first, last}, known->name));
        if (first_function_ == k_no_node) {
            first_function_ = function;
            first_use_ = id;
        }
        saved_ += work_.of(id) - work_.once(id);
    }

    std::string next_name() {
        std::string name;
        do
            name = fresh_name(text_, "same_everywhere", ++last_name_);
        while (std::ranges::find(values_, name, &SharedValue::name) != values_.end());
        return name;
    }

    /// Returns the expression's text if it means the same in mainImage. Returns nothing if it cannot be
    /// written there or spans several lines.
    std::optional<std::string> said_in_main(NodeId id) {
        const auto [begin, end] = edits_.tokens_of(tree_[id].begin, tree_[id].end);
        const text::Token &first = text_.tokens()[begin], &last = text_.tokens()[end];
        const auto is_parameter = [&](std::string_view name, bool member) {
            return !member && std::ranges::count(parameters_, name) > 0;
        };
        auto words = expressions_.spelled(id, k_longest, is_parameter);
        if (!words || first.line != last.line || file_of(id) != file_of(main_))
            return std::nullopt;
        bool as_written = true;
        for (size_t i = begin; i <= end; ++i) {
            const std::string_view token = text_.tokens()[i].text;
            as_written = as_written && !expressions_.alias(token) && token.find("/*") == token.npos &&
                         std::ranges::count(text_.preprocessed().macros, token, &MacroLine::name) <= 1;
        }
        return as_written ? text_.source().text().substr(first.begin, last.end() - first.begin) : words;
    }
    std::optional<Cut> cut() {
        std::string declarations, assignments;
        for (const SharedValue& value : values_) {
            declarations += fmt::format("{} {}; ", value.type, value.name);
            assignments += fmt::format(" {} = {};", value.name, value.words);
        }
        auto declared = at_word(text_, tree_[first_function_].begin, declarations, "");
        auto assigned = at_word(text_, tree_[body_of_function(text_, main_)].begin, "", assignments);
        if (!declared || !assigned)
            return std::nullopt;
        Cut cut{{{}, reason()}, saved_, true};
        cut.change.wraps = {*std::move(declared), *std::move(assigned)};
        std::ranges::move(uses_, std::back_inserter(cut.change.wraps));
        return cut;
    }

    std::string reason() const {
        const SourceLocation where = text_.used(tree_[first_use_].begin);
        const size_t others = values_.size() - 1;
        return fmt::format("{}:{}: computes `{}`{} once per pixel instead of repeatedly in loops and calls",
                           where.file, where.line, text_.excerpt(first_use_),
                           others > 0 ? fmt::format(" and {} more", others) : "");
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    const WorkEstimate& work_;
    std::vector<Global> globals_;
    UniformExpressions expressions_;
    WordEdits edits_;
    NodeId main_ = k_no_node, first_function_ = k_no_node, first_use_ = k_no_node;
    std::vector<std::string_view> parameters_{};
    std::vector<SharedValue> values_{};
    std::vector<Wrap> uses_{};
    size_t last_name_ = 0;
    double saved_ = 0;
};

} // namespace

std::optional<Cut> half_size(std::span<const BufferReader> passes, size_t buffer, const WorkEstimate& work) {
    const ParsedText& text = passes[buffer].text;
    const NodeId main = find_main_image(text);
    if (main == k_no_node || !passes[buffer].samplers.empty() || says(text, "gl_FragCoord") ||
        says(text, "mainHit"))
        return std::nullopt;
    auto drawn = drawn_small(text, main);
    if (!drawn)
        return std::nullopt;
    const SourceLocation where = text.used(text.tree()[main].begin);
    Cut cut{{{*std::move(drawn)},
             fmt::format("{}:{}: draws the buffer at half its width and height", where.file, where.line)},
            work.of(body_of_function(text, main)) * k_saved,
            false,
            true};
    for (const BufferReader& reader : passes)
        for (const BufferSampler& sampler : reader.samplers) {
            auto wraps = LookUps(reader, sampler).run();
            if (!wraps)
                return std::nullopt;
            std::ranges::move(*wraps, std::back_inserter(cut.change.wraps));
        }
    const std::set<std::string> shared = shared_files(passes);
    const bool read = cut.change.wraps.size() > 1;
    const bool own = std::ranges::none_of(
        cut.change.wraps, [&](const Wrap& wrap) { return shared.contains(wrap.first.where.file); });
    return read && own ? std::optional(std::move(cut)) : std::nullopt;
}

std::optional<Cut> once_a_pixel(const ParsedText& text, const TreeFacts& facts, const WorkEstimate& work) {
    return CutFinder(text, facts, work).run();
}

} // namespace tidemark::glsl
