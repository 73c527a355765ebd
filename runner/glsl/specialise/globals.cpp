#include "glsl/specialise/globals.hpp"

#include "glsl/syntax/tree_facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

namespace tidemark::glsl {
namespace {

constexpr std::string_view k_interface[] = {"uniform", "in",      "out",       "inout",  "buffer",
                                            "shared",  "varying", "attribute", "layout", "invariant"};

bool is_interface(const ParsedText& text, NodeId type) {
    return std::any_of(std::begin(k_interface), std::end(k_interface),
                       [&](std::string_view word) { return has_qualifier(text, type, word); });
}

/// Returns whether the token is `++`, `--`, `+=` or similar; not `=`, which a declarator has.
bool changes_something(const Word& word) {
    if (word.kind != text::TokenKind::punctuation || word.text.size() < 2)
        return false;
    return word.is("++") || word.is("--") ||
           (word.text.back() == '=' && !word.is("==") && !word.is("!=") && !word.is("<=") && !word.is(">="));
}

class Finder {
public:
    explicit Finder(const ParsedText& text) : text_(text), tree_(text.tree()) {}

    std::vector<Global> run() {
        NodeId first = 1;
        for (const NodeId node : tree_.children(0)) {
            globals_.push_back({node, first});
            first = node + 1;
            if (tree_[node].kind == NodeKind::function)
                functions_.insert(text_.word_of(node));
        }
        for (Global& global : globals_)
            read(global);
        return std::move(globals_);
    }

private:
    void read(Global& global) const {
        if (tree_[global.node].kind == NodeKind::function) {
            global.names = {text_.word_of(global.node)};
            global.root = text_.word_of(global.node) == "main";
        } else if (tree_[global.node].kind == NodeKind::declaration) {
            read_declaration(global);
        } else {
            global.root = true;
        }
    }

    void read_declaration(Global& global) const {
        const NodeId type = tree_.child(global.node, 0);
        if (const NodeId structure = tree_.child(type, 0); structure != k_no_node)
            global.names.push_back(text_.word_of(structure));
        size_t values = 0; // each declarator may have one
        for (NodeId name = tree_[type].next; name != k_no_node; name = tree_[name].next) {
            global.names.push_back(text_.word_of(name));
            ++values;
        }
        size_t assignments = 0;
        for (size_t i = tree_[global.node].begin; i < tree_[global.node].end; ++i) {
            const Word& word = text_.words()[i];
            assignments += word.is("=");
            global.root = global.root || changes_something(word) ||
                          (word.kind == text::TokenKind::identifier && functions_.contains(word.text));
        }
        const bool of_the_driver = std::any_of(global.names.begin(), global.names.end(),
                                               [](std::string_view name) { return name.starts_with("gl_"); });
        global.root = global.root || global.names.empty() || assignments > values || of_the_driver ||
                      is_interface(text_, type);
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    std::vector<Global> globals_;
    std::unordered_set<std::string_view> functions_;
};

/// Moves the values of global variables into `main` and writes the text anew.
class ValueMover {
public:
    explicit ValueMover(const ParsedText& text)
        : text_(text), tree_(text.tree()), inserted_(text.words().size() + 1), gone_(text.words().size()) {}

    std::string run() {
        NodeId main = k_no_node;
        size_t body = 0; // the token after its `{`
        for (const NodeId node : tree_.children(0)) {
            const NodeId last = tree_.children(node).empty() ? k_no_node : tree_.children(node).back();
            if (tree_[node].kind == NodeKind::declaration)
                read(tree_.child(node, 0));
            else if (tree_[node].kind == NodeKind::function && text_.word_of(node) == "main" &&
                     tree_[last].kind == NodeKind::block) {
                main = node;
                body = tree_[last].begin + 1;
            }
        }
        if (assignments_.empty() || body == 0)
            return text_.source().text();
        inserted_[body] = fmt::format("{}\n#line {}\n", assignments_, line_of(body - 1));
        // The host's main may precede the author's variables, so it moves to the end.
        Writer writer{*this, text_.headers()};
        writer.write(0, tree_[main].begin);
        writer.write(tree_[main].end, gone_.size());
        writer.write(tree_[main].begin, tree_[main].end);
        return std::move(writer.result);
    }

private:
    int line_of(size_t word) const { return text_.tokens()[text_.words()[word].used].line; }

    std::string words(size_t begin, size_t end) const {
        std::string words;
        for (size_t i = begin; i < end; ++i)
            words += fmt::format("{} ", text_.word(i));
        return words;
    }

    void read(NodeId type) {
        if (is_given(text_, type))
            return;
        for (NodeId declared = tree_[type].next; declared != k_no_node; declared = tree_[declared].next)
            for (NodeId part = tree_[declared].first_child; part != k_no_node; part = tree_[part].next)
                if (!is_bracket(text_, part))
                    move(type, declared, part);
    }

    void move(NodeId type, NodeId declared, NodeId value) {
        const Node& node = tree_[value];
        const std::string name(text_.word_of(declared)), text = words(node.begin, node.end);
        std::fill(gone_.begin() + node.begin - 1, gone_.begin() + node.end, true); // the `=` too
        if (node.kind == NodeKind::braces) // allowed in declarations only
            assignments_ += fmt::format("\n#line {0}\n{{ {1} {2} {3} = {4}; {5} = {2}; }}",
                                        line_of(node.begin), name_of(type), k_value,
                                        words(tree_[declared].word + 1, node.begin - 1), text, name);
        else
            assignments_ += fmt::format("\n#line {}\n{} = {};", line_of(node.begin), name, text);
        // An array without a size had its size from this value.
        for (size_t i = tree_[type].begin; i + 1 < node.begin; ++i)
            if (text_.word(i) == "[" && text_.word(i + 1) == "]" &&
                (i < tree_[type].end || i > tree_[declared].word))
                inserted_[i + 1] = node.kind == NodeKind::braces ? std::to_string(tree_.child_count(value))
                                                                 : fmt::format("({}).length()", text);
    }

    /// Returns a type's tokens without a structure's members, which are declared at its definition.
    std::string name_of(NodeId type) const {
        const NodeId structure = tree_.child(type, 0);
        return structure == k_no_node ? words(tree_[type].begin, tree_[type].end)
                                      : std::string(text_.word_of(structure));
    }

    /// Writes tokens on the lines that they have in the text.
    struct Writer {
        const ValueMover& mover;
        std::string result;
        int line = 1 + int(std::ranges::count(result, '\n'));

        void write(size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                result += mover.inserted_[i];
                if (mover.gone_[i])
                    continue;
                const int its_line = mover.line_of(i);
                if (line > its_line)
                    result += fmt::format("\n#line {}\n", its_line);
                else
                    result.append(size_t(its_line - line), '\n');
                line = its_line;
                result.append(mover.text_.word(i)) += ' ';
            }
        }
    };

    static constexpr std::string_view k_value = "tidemark_value";

    const ParsedText& text_;
    const SyntaxTree& tree_;
    std::vector<std::string> inserted_; ///< before each token
    std::vector<bool> gone_;            ///< per token
    std::string assignments_;
};

} // namespace

std::string assign_globals_in_main(const ParsedText& text) {
    return ValueMover(text).run();
}

std::vector<Global> find_globals(const ParsedText& text) {
    return Finder(text).run();
}

std::vector<bool> find_reached(const ParsedText& text, const std::vector<Global>& globals,
                               const std::vector<bool>& gone, const std::vector<bool>& kept) {
    std::unordered_map<std::string_view, std::vector<size_t>> named;
    std::vector<bool> reached = kept;
    std::vector<size_t> open;
    for (size_t i = 0; i < globals.size(); ++i) {
        for (const std::string_view name : globals[i].names)
            named[name].push_back(i);
        if (reached[i])
            open.push_back(i);
    }
    while (!open.empty()) {
        const Node& node = text.tree()[globals[open.back()].node];
        open.pop_back();
        for (size_t i = node.begin; i < node.end; ++i) {
            const Word& word = text.words()[i];
            if (word.kind != text::TokenKind::identifier || (!gone.empty() && gone[i]))
                continue;
            const auto found = named.find(word.text);
            if (found == named.end())
                continue;
            for (const size_t global : found->second)
                if (!reached[global]) {
                    reached[global] = true;
                    open.push_back(global);
                }
            named.erase(found);
        }
    }
    return reached;
}

Variables find_variables(const ParsedText& text, NodeId first, NodeId last) {
    const SyntaxTree& tree = text.tree();
    Variables variables;
    const auto declare = [&](NodeId type, NodeId declared) {
        Variable& variable = variables[text.word_of(declared)];
        if (variable.times++ == 0)
            variable = {type, declared, 1};
    };
    for (NodeId id = first; id <= last; ++id) {
        const NodeId type = tree.child(id, 0);
        if (tree[id].kind == NodeKind::parameter)
            declare(type, id);
        else if (tree[id].kind == NodeKind::declaration && tree[tree[id].parent].kind != NodeKind::structure)
            for (NodeId name = tree[type].next; name != k_no_node; name = tree[name].next)
                declare(type, name);
    }
    return variables;
}

Variables find_global_variables(const ParsedText& text, const std::vector<Global>& globals) {
    Variables variables;
    for (const Global& global : globals)
        if (text.tree()[global.node].kind == NodeKind::declaration)
            for (const auto& [name, variable] : find_variables(text, global.first, global.node)) {
                Variable& known = variables[name];
                const unsigned times = known.times + variable.times;
                known = variable;
                known.times = times;
            }
    return variables;
}

} // namespace tidemark::glsl
