#include "glsl/specialise/globals.hpp"

#include "glsl/syntax/tree_facts.hpp"

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

/// `++`, `--`, `+=`, …; not `=`, which a declarator has.
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

} // namespace

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
