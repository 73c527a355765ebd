#include "glsl/initialise.hpp"

#include "glsl/flow/assigned.hpp"
#include "glsl/flow/zero_value.hpp"
#include "glsl/syntax/gap_edits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace tidemark::glsl {
namespace {

/// Function, called when `main` begins, that sets the globals that are too large for an initialiser.
constexpr std::string_view k_start = "tidemark_start";
constexpr std::string_view k_value = "tidemark_value";
constexpr std::string_view k_unnamed = "tidemark_unnamed";

class Zeros {
public:
    explicit Zeros(const ParsedText& text)
        : text_(text), tree_(text.tree()), facts_(find_facts(text)), shapes_(text), gaps_(text) {}

    struct Changes {
        std::vector<text::Edit> edits;
        std::string functions; ///< text to append
    };

    Changes run() {
        const Assignment all = find_assignment(text_, facts_, shapes_);
        for (const UnsetVariable& variable : all.variables)
            if (variable.parameter)
                parameter(variable);
            else if (variable.global)
                global(variable);
            else
                local(variable);
        for (const NodeId function : all.without_return)
            add_return(function);
        for (NodeId id = tree_[0].first_child; id != k_no_node; id = tree_[id].next)
            if (tree_[id].kind == NodeKind::function)
                name_parameters(id);
        if (!start_.empty())
            start_in_main();
        Changes changes{gaps_.edits(), {}};
        if (!start_.empty()) // the author's last line may end in a backslash
            changes.functions = fmt::format("\nvoid {}() {{ {}}}\n", k_start, start_);
        return changes;
    }

private:
    void local(const UnsetVariable& variable) {
        const Node& declaration = tree_[tree_[variable.declared].parent];
        const bool statement = tree_[declaration.parent].kind == NodeKind::block;
        const std::string set = statement ? statements(name_of(variable), *variable.shape) : std::string();
        if (const auto value = zero(*variable.shape)) {
            const size_t behind = tree_[variable.declared].end;
            gaps_.offer(behind, "=" + *value, variable.needs_value());
            if (statement)
                gaps_.offer_else(behind, declaration.end, set);
        } else if (statement) {
            gaps_.offer(declaration.end, set, variable.needs_value());
        }
    }

    void global(const UnsetVariable& variable) {
        if (const auto value = zero(*variable.shape))
            gaps_.offer(tree_[variable.declared].end, "=" + *value, variable.needs_value());
        else if (variable.needs_value())
            start_ += statements(name_of(variable), *variable.shape);
    }

    void parameter(const UnsetVariable& variable) {
        const NodeId function = tree_[variable.declared].parent;
        for (NodeId body = tree_[variable.declared].next; body != k_no_node; body = tree_[body].next)
            if (tree_[body].kind == NodeKind::block && tree_[body].parent == function)
                gaps_.offer(tree_[body].begin + 1, statements(name_of(variable), *variable.shape),
                            variable.needs_value());
    }

    void add_return(NodeId function) {
        const Shape& shape = shapes_.of(tree_.child(function, 0), k_no_node);
        if (!shape.can_be_zero() || shape.type.empty())
            return;
        const auto value = zero(shape);
        const std::string text = value ? fmt::format("return {};", *value)
                                       : fmt::format("{} {};{}return {};", constructor_of(shape), k_value,
                                                     statements(std::string(k_value), shape), k_value);
        gaps_.offer(tree_[function].end - 1, text, true);
    }

    /// Mesa accepts a definition such as `float f(vec2) {…}` in GLSL ES only.
    void name_parameters(NodeId function) {
        const std::vector<NodeId> parts = tree_.children(function);
        if (tree_[parts.back()].kind != NodeKind::block)
            return;
        for (size_t i = 0; i < parts.size(); ++i) {
            const NodeId type = tree_[parts[i]].first_child;
            if (tree_[parts[i]].kind == NodeKind::parameter && tree_[parts[i]].word < tree_[type].end)
                gaps_.offer(tree_[type].end, fmt::format(" {}_{}", k_unnamed, i), true);
        }
    }

    void start_in_main() {
        for (NodeId id = tree_[0].first_child; id != k_no_node; id = tree_[id].next) {
            if (tree_[id].kind != NodeKind::function || text_.word_of(id) != "main")
                continue;
            gaps_.offer(tree_[id].begin, fmt::format("void {}();", k_start), true);
            for (const NodeId part : tree_.children(id))
                if (tree_[part].kind == NodeKind::block)
                    gaps_.offer(tree_[part].begin + 1, fmt::format("{}();", k_start), true);
        }
    }

    std::string name_of(const UnsetVariable& variable) const {
        return std::string(text_.word_of(variable.declared));
    }

    std::optional<std::string> zero(const Shape& shape) const { return zero_value(shape, facts_); }

    std::string statements(const std::string& place, const Shape& shape, int depth = 0) const {
        if (const auto value = zero(shape))
            return fmt::format("{}={};", place, *value);
        std::string text;
        if (shape.kind == Shape::Kind::structure) {
            for (const Shape::Member& member : shape.members)
                text += statements(fmt::format("{}.{}", place, member.name), *member.shape, depth);
            return text;
        }
        const std::string length =
            shape.length > 0 ? std::to_string(shape.length) : fmt::format("{}.length()", place);
        return fmt::format("for(int tidemark_{0}=0;tidemark_{0}<{1};++tidemark_{0}){{{2}}}", depth, length,
                           statements(fmt::format("{}[tidemark_{}]", place, depth), *shape.part, depth + 1));
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts facts_;
    Shapes shapes_;
    GapEdits gaps_;
    std::string start_;
};

} // namespace

void start_at_zero(text::MappedText& text, Version version) {
    const bool es = version == Version::es_300;
    const std::array<KnownMacro, 3> known{{{"__VERSION__", es                             ? 300
                                                           : version == Version::core_450 ? 450
                                                                                          : 330},
                                           {"GL_FRAGMENT_PRECISION_HIGH", 1},
                                           {es ? "GL_ES" : "GL_core_profile", 1}}};
    const auto parsed = ParsedText::read(text, known, false);
    if (!parsed) {
        const std::vector<text::Token> tokens = text::tokenize(text.text());
        text.apply(initialise_plain(tokens, preprocess(tokens)));
        return;
    }
    const Zeros::Changes changes = Zeros(**parsed).run();
    text.apply(changes.edits);
    text.append_generated(changes.functions);
}

} // namespace tidemark::glsl
