#include "shader/lens_text.hpp"

#include "base/error.hpp"
#include "shader/lens_writer.hpp"
#include "shader/march_record.hpp"
#include "shader/source_edits.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>

namespace tidemark::glsl {
namespace {

/// `@` stores `v`, the next value.
constexpr std::string_view k_value_functions = R"(vec4 $value = vec4(0.0);
int $times = 0;
float $lesser(float a, float b) { return isnan(a) || a < b ? a : b; }
float $larger(float a, float b) { return isnan(a) || a > b ? a : b; }
void $put(vec4 v) {
    ++$times;
    @
}
)";

constexpr std::string_view k_least =
    "$value = $times == 1 ? v : vec4($lesser($value.x, v.x), $lesser($value.y, v.y), "
    "$lesser($value.z, v.z), $lesser($value.w, v.w));";
constexpr std::string_view k_most_of_values =
    "$value = $times == 1 ? v : vec4($larger($value.x, v.x), $larger($value.y, v.y), "
    "$larger($value.z, v.z), $larger($value.w, v.w));";

/// Returns the functions `$see` for every scalar and vector type.
std::string see_functions(std::string_view prefix) {
    std::string text;
    for (size_t i = 0; i < std::size(k_vectors); ++i) {
        const size_t rows = i % 4 + 1;
        std::string zeros;
        for (size_t row = rows; row < 4; ++row)
            zeros += ", 0.0";
        const std::string floats = rows == 1 ? "float(v)" : fmt::format("vec{}(v)", rows);
        text += fmt::format("{0} {1}see({0} v) {{ {1}put(vec4({2}{3})); return v; }}\n", k_vectors[i], prefix,
                            floats, zeros);
    }
    return text;
}

bool is_swizzle(std::string_view member) {
    return member.size() == 1 && std::string_view("xyzwrgbastpq").find(member[0]) != std::string_view::npos;
}

size_t row_of_swizzle(char member) {
    return std::string_view("xyzwrgbastpq").find(member) % 4;
}

class ValueWriter : LensWriter {
public:
    ValueWriter(const ParsedText& text, const TreeFacts& facts, const SeenValue& request)
        : LensWriter(text, facts), request_(request) {
        split_variable();
    }

    Result<ValueText> run() {
        TRY(check());
        result_.place = resolved(request_.place);
        collect();
        TRY(choose());
        result_.text = written(functions(), answer());
        return std::move(result_);
    }

private:
    /// A place of the line that gives a value.
    struct Candidate {
        NodeId node =
            k_no_node;      ///< a declarator, an assignment, a return, or a statement that calls a function
        std::string name{}; ///< of the variable; `return`
    };

    /// Separates the component of `p.x` from the variable.
    void split_variable() {
        variable_ = request_.variable;
        const size_t dot = variable_.rfind('.');
        if (dot == std::string::npos || !is_swizzle(std::string_view(variable_).substr(dot + 1)))
            return;
        row_ = row_of_swizzle(variable_[dot + 1]);
        variable_.resize(dot);
    }

    void collect() {
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
            if (!is_on(result_.place, id) || must_stay_constant(text_, id))
                continue;
            const NodeKind kind = tree_[id].kind;
            if (kind == NodeKind::declarator && value_of(id) != k_no_node &&
                tree_.around(id, NodeKind::function) != k_no_node)
                add(id, std::string(text_.word_of(id)));
            else if (kind == NodeKind::return_statement && tree_.child(id, 0) != k_no_node)
                add(id, "return");
            else if (kind == NodeKind::assign || kind == NodeKind::postfix || kind == NodeKind::prefix)
                add_change(id);
            else if (kind == NodeKind::call)
                for (const std::string_view name : names_set(text_, facts_, id))
                    add(id, std::string(name));
        }
        std::ranges::stable_sort(found_, {}, [&](const Candidate& each) { return tree_[each.node].word; });
    }

    void add(NodeId node, std::string name) { found_.push_back({node, std::move(name)}); }

    void add_change(NodeId id) {
        if (is_change(text_, id))
            if (const NodeId base = base_of(tree_, tree_.child(id, 0)); tree_[base].kind == NodeKind::name)
                add(id, std::string(text_.word_of(base)));
    }

    /// Returns the initialiser of a declarator; k_no_node: it has none.
    NodeId value_of(NodeId declarator) const {
        for (const NodeId part : tree_.children(declarator))
            if (!is_bracket(text_, part))
                return part;
        return k_no_node;
    }

    std::vector<std::string> names() const {
        std::vector<std::string> names;
        for (const Candidate& each : found_)
            if (std::ranges::find(names, each.name) == names.end())
                names.push_back(each.name);
        return names;
    }

    Result<void> choose() {
        const std::vector<std::string> all = names();
        if (variable_.empty() && all.size() != 1)
            return fail(ErrorCode::usage,
                        all.empty()
                            ? fmt::format("{} sets no variable; name one that it reads, as in value:{}:p",
                                          name_of_place(result_.place), result_.place.line)
                            : fmt::format("{} sets {}; name one of them, as in value:{}:{}",
                                          name_of_place(result_.place), fmt::join(all, ", "),
                                          result_.place.line, all.front()));
        result_.name = variable_.empty() ? all.front() : variable_;
        bool any = false;
        for (const Candidate& each : found_)
            if (each.name == result_.name) {
                wrap(each);
                any = true;
            }
        if (!any && !wrap_read())
            return fail(ErrorCode::usage,
                        fmt::format("{} neither sets nor reads a variable {}{}", name_of_place(result_.place),
                                    result_.name,
                                    all.empty() ? "" : fmt::format("; it sets {}", fmt::join(all, ", "))));
        if (row_)
            result_.name = request_.variable;
        return {};
    }

    bool is_whole(std::string_view name) const {
        const auto meaning = facts_.names.find(name);
        return meaning != facts_.names.end() && !meaning->second.array && !meaning->second.structure;
    }

    /// Returns whether the value of the expression is not used.
    bool is_dropped(NodeId id) const {
        const NodeKind parent = tree_[tree_[id].parent].kind;
        return parent == NodeKind::expression ||
               (parent == NodeKind::loop_for && tree_.child(tree_[id].parent, 2) == id);
    }

    void note_type(NodeId expression) {
        const auto type = expression_type(text_, facts_, expression);
        note_type(type);
        if (result_.excerpt.empty())
            result_.excerpt = text_.excerpt(expression);
    }
    void note_type(const std::optional<ValueType>& type) {
        if (type && !type->matrix())
            result_.components = std::max(result_.components, type->rows);
    }

    void wrap(const Candidate& each) {
        const NodeKind kind = tree_[each.node].kind;
        if (kind == NodeKind::declarator) {
            note_type(value_type(type_name(text_, tree_.child(tree_[each.node].parent, 0))));
            see(value_of(each.node));
        } else if (kind == NodeKind::return_statement) {
            const NodeId function = tree_.around(each.node, NodeKind::function);
            note_type(value_type(type_name(text_, tree_.child(function, 0))));
            see(tree_.child(each.node, 0));
        } else if (is_dropped(each.node) && is_whole(each.name)) {
            const NodeId base = base_of_written(each);
            note_type(base);
            edits_.wrap(each.node, "(", fmt::format(",{}see({}))", prefix_, each.name));
        } else if (kind == NodeKind::assign) {
            note_type(tree_.child(each.node, 0));
            see(each.node);
        } else if (const NodeId statement = statement_around(each.node); is_whole(each.name)) {
            note_type(base_of_written(each));
            edits_.wrap(statement, "{", fmt::format("{}see({});}}", prefix_, each.name));
        }
    }

    /// Returns the name that the candidate writes.
    NodeId base_of_written(const Candidate& each) const {
        if (tree_[each.node].kind != NodeKind::call)
            return base_of(tree_, tree_.child(each.node, 0));
        for (const NodeId part : tree_.children(each.node))
            if (const NodeId base = base_of(tree_, part);
                tree_[base].kind == NodeKind::name && text_.word_of(base) == each.name)
                return base;
        return k_no_node;
    }

    NodeId statement_around(NodeId id) const {
        while (tree_[id].kind != NodeKind::expression && tree_[id].parent != k_no_node)
            id = tree_[id].parent;
        return id;
    }

    void see(NodeId expression) {
        if (result_.excerpt.empty())
            result_.excerpt = text_.excerpt(expression);
        edits_.wrap(expression, prefix_ + "see(", ")");
    }

    /// Shows the variable where the line first reads it. Returns false if it does not.
    bool wrap_read() {
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
            if (tree_[id].kind != NodeKind::name || text_.word_of(id) != variable_ ||
                !is_on(result_.place, id) || must_stay_constant(text_, id) || !is_whole(variable_))
                continue;
            const NodeId parent = tree_[id].parent;
            const bool callee = tree_[parent].kind == NodeKind::call && tree_.child(parent, 0) == id;
            if (callee || is_change(text_, parent))
                continue;
            note_type(id);
            see(id);
            return true;
        }
        return false;
    }

    std::string functions() const {
        using Pick = SeenValue::Pick;
        std::string stores;
        switch (request_.pick) {
        case Pick::last: stores = "$value = v;"; break;
        case Pick::least: stores = k_least; break;
        case Pick::most: stores = k_most_of_values; break;
        case Pick::number: stores = fmt::format("if ($times == {}) $value = v;", request_.number); break;
        }
        return spell(k_value_functions, prefix_, spell(stores, prefix_)) + see_functions(prefix_);
    }

    std::string answer() {
        const uint32_t least = request_.pick == SeenValue::Pick::number ? request_.number : 1;
        const std::string has = fmt::format("$times >= {} ? 1.0 : 0.0", least);
        if (row_)
            result_.components = 1;
        return row_ ? fmt::format("$lens(vec4($value[{}], 0.0, 0.0, {}), color)", *row_, has)
                    : fmt::format("$lens(vec4($value.xyz, {}), color)", has);
    }

    const SeenValue& request_;
    std::string variable_;
    std::optional<size_t> row_;
    std::vector<Candidate> found_;
    ValueText result_;
};

/// `$seen`: bit 0 if the condition was false, bit 1 if it was true.
constexpr std::string_view k_branch_functions = R"(int $seen = 0;
bool $side(bool holds) {
    $seen |= holds ? 2 : 1;
    return holds;
}
)";

class BranchWriter : LensWriter {
public:
    using LensWriter::LensWriter;

    Result<ValueText> run(const SourceLocation& place, int which) {
        TRY(check());
        ValueText result;
        result.place = resolved(place);
        std::vector<NodeId> conditions = conditions_of(result.place);
        if (conditions.empty())
            return fail(ErrorCode::usage, fmt::format("{} has no condition of an if, a loop or a ?:{}",
                                                      name_of_place(result.place), nearest(result.place)));
        if (which == 0 && conditions.size() > 1)
            return fail(ErrorCode::usage,
                        fmt::format("{} has {} conditions; name one by its number, as in branch:{}:1",
                                    name_of_place(result.place), conditions.size(), result.place.line));
        if (which > int(conditions.size()))
            return fail(ErrorCode::usage,
                        fmt::format("{} has only {} condition{}", name_of_place(result.place),
                                    conditions.size(), conditions.size() > 1 ? "s" : ""));
        const NodeId condition = conditions[size_t(std::max(1, which) - 1)];
        result.name = result.excerpt = text_.excerpt(condition);
        edits_.wrap(condition, prefix_ + "side(", ")");
        result.components = 1;
        result.text = written(spell(k_branch_functions, prefix_),
                              "$lens(vec4(float($seen - 1), 0.0, 0.0, $seen == 0 ? 0.0 : 1.0), color)");
        return result;
    }

private:
    NodeId condition_of(NodeId id) const {
        switch (tree_[id].kind) {
        case NodeKind::if_else:
        case NodeKind::conditional:
        case NodeKind::loop_while: return tree_.child(id, 0);
        case NodeKind::loop_for:
        case NodeKind::loop_do: return tree_.child(id, 1);
        default: return k_no_node;
        }
    }

    bool can_be_watched(NodeId condition) const {
        return condition != k_no_node && is_expression(tree_[condition].kind) &&
               !must_stay_constant(text_, condition) &&
               tree_.around(condition, NodeKind::function) != k_no_node;
    }

    std::vector<NodeId> conditions_of(const SourceLocation& place) const {
        std::vector<NodeId> conditions;
        for (NodeId id = 1; id < tree_.nodes.size(); ++id)
            if (const NodeId condition = condition_of(id);
                can_be_watched(condition) && is_at(place, tree_[condition].begin))
                conditions.push_back(condition);
        std::ranges::sort(conditions, {}, [&](NodeId id) { return tree_[id].begin; });
        return conditions;
    }

    std::string nearest(const SourceLocation& place) const {
        std::set<std::pair<int, int>> lines; // distance, line
        for (NodeId id = 1; id < tree_.nodes.size(); ++id)
            if (const NodeId condition = condition_of(id); can_be_watched(condition))
                if (const SourceLocation at = text_.used(tree_[condition].begin); at.file == place.file)
                    lines.emplace(std::abs(at.line - place.line), at.line);
        return lines.empty() ? "" : fmt::format("; the nearest line with one is {}", lines.begin()->second);
    }
};

class LoopWriter : LensWriter {
public:
    using LensWriter::LensWriter;

    Result<ValueText> run(const SourceLocation& place) {
        TRY(check());
        ValueText result;
        result.place = resolved(place);
        NodeId loop = k_no_node;
        for (NodeId id = 1; id < tree_.nodes.size(); ++id)
            if (is_loop(tree_[id].kind) && is_at(result.place, tree_[id].begin) && loop == k_no_node)
                loop = id;
        if (loop == k_no_node)
            return fail(ErrorCode::usage, fmt::format("no loop begins at {}{}", name_of_place(result.place),
                                                      loops(result.place)));
        edits_.wrap(body_of(tree_, loop), fmt::format("{{++{}times;", prefix_), "}");
        result.name = "iterations";
        result.components = 1;
        result.text =
            written(spell("int $times = 0;\n", prefix_), "$lens(vec4(float($times), 0.0, 0.0, 1.0), color)");
        return result;
    }

private:
    std::string loops(const SourceLocation& place) const {
        std::set<int> lines;
        for (NodeId id = 1; id < tree_.nodes.size(); ++id)
            if (is_loop(tree_[id].kind))
                if (const SourceLocation at = text_.used(tree_[id].begin); at.file == place.file)
                    lines.insert(at.line);
        return lines.empty() ? ""
                             : fmt::format("; loops of that file begin at line {}", fmt::join(lines, ", "));
    }
};

/// GLSL: `$elapsed(c)` returns the cycles since `$start`, when the colour c is known: for a compiler, its
/// bits decide how often the loop reads the clock.
constexpr std::string_view k_clock_functions = R"(uvec2 $start = uvec2(0u);
uvec2 $clock() {
#ifdef GL_ARB_shader_clock
    return clock2x32ARB();
#else
    return uvec2(0u);
#endif
}
float $elapsed(vec4 c) {
    uvec4 bits = floatBitsToUint(c);
    int turns = (bits.x ^ bits.y ^ bits.z ^ bits.w) == 0x9E3779B1u ? 2 : 1;
    uvec2 end = $start;
    for (int i = 0; i < turns; ++i)
        end = $clock();
    uint high = end.y - $start.y - (end.x < $start.x ? 1u : 0u);
    return float(high) * 4294967296.0 + float(end.x - $start.x);
}
)";

class ClockWriter : LensWriter {
public:
    using LensWriter::LensWriter;

    Result<text::MappedText> run() {
        TRY(check());
        edits_.wrap(body_of_function(text_, find_main_image(text_)),
                    fmt::format("{{{0}start={0}clock();", prefix_), "}");
        return written(spell(k_clock_functions, prefix_),
                       "$lens(vec4($elapsed(color), 0.0, 0.0, 1.0), color)",
                       "#extension GL_ARB_shader_clock : enable\n");
    }
};

} // namespace

Result<ValueText> show_value(const ParsedText& text, const TreeFacts& facts, const SeenValue& request) {
    return ValueWriter(text, facts, request).run();
}

Result<ValueText> show_branch(const ParsedText& text, const TreeFacts& facts, const SourceLocation& place,
                              int which) {
    return BranchWriter(text, facts).run(place, which);
}

Result<text::MappedText> measure_clocks(const ParsedText& text, const TreeFacts& facts) {
    return ClockWriter(text, facts).run();
}

Result<ValueText> count_iterations(const ParsedText& text, const TreeFacts& facts,
                                   const SourceLocation& place) {
    return LoopWriter(text, facts).run(place);
}

std::vector<SourceLocation> countable_loops(const ParsedText& text) {
    const SyntaxTree& tree = text.tree();
    const NodeId main_image = find_main_image(text);
    std::set<std::pair<size_t, NodeId>> loops; // first word, node
    for (NodeId id = 1; id < tree.nodes.size() && main_image != k_no_node; ++id)
        if (is_loop(tree[id].kind))
            loops.emplace(tree[id].begin, id);
    std::vector<SourceLocation> places;
    for (const auto& [begin, loop] : loops) {
        SourceLocation place = text.used(begin);
        if (place.file == text.spelled(tree[main_image].word).file)
            place.file.clear();
        if (std::ranges::none_of(places, [&](const SourceLocation& other) {
                return other.line == place.line && other.file == place.file;
            }))
            places.push_back(std::move(place));
    }
    return places;
}

} // namespace tidemark::glsl
