#include "shader/uniform_expressions.hpp"

#include "shader/builtin_functions.hpp"
#include "shader/tree_facts.hpp"

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

class ExpressionFinder {
public:
    explicit ExpressionFinder(const ParsedText& text) : text_(text), tree_(text.tree()) {}

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

/// Longest chain of calls that is followed.
constexpr int k_deepest_calls = 60;
/// Longest chain of local variables whose values are local variables.
constexpr int k_longest_alias_chain = 8;

/// Returns the variables that the nodes [first, last] declare, without members of structures.
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

/// Returns the variables of the outermost level, each with its last declaration there.
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

} // namespace

std::string assign_globals_in_main(const ParsedText& text) {
    return ValueMover(text).run();
}

std::vector<Global> find_globals(const ParsedText& text) {
    return ExpressionFinder(text).run();
}

std::vector<bool> find_reached(const ParsedText& text, const std::vector<Global>& globals,
                               const std::vector<bool>& kept) {
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
            const auto found = word.kind == text::TokenKind::identifier ? named.find(word.text) : named.end();
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

UniformExpressions::UniformExpressions(const ParsedText& text, const std::vector<Global>& globals)
    : text_(text), tree_(text.tree()) {
    read_globals(globals);
}

/// Collects numeric uniforms and constants; leaves names with several meanings.
void UniformExpressions::read_globals(const std::vector<Global>& globals) {
    globals_ = find_global_variables(text_, globals);
    for (const Global& global : globals)
        if (tree_[global.node].kind == NodeKind::function)
            functions_[text_.word_of(global.node)].push_back(&global);
    for (const Global& global : globals) { // a constant may use those before it
        if (tree_[global.node].kind != NodeKind::declaration)
            continue;
        const NodeId type = tree_.child(global.node, 0);
        const auto numeric = value_type(type_name(text_, type));
        const bool uniform = has_qualifier(text_, type, "uniform");
        if (!numeric || (!uniform && !has_qualifier(text_, type, "const")))
            continue;
        for (NodeId name = tree_[type].next; name != k_no_node; name = tree_[name].next)
            if (globals_[text_.word_of(name)].times == 1 && dimensions(text_, type, name) == 0 &&
                !functions_.contains(text_.word_of(name)))
                settled_[text_.word_of(name)] = {*numeric, uniform, false};
    }
}

void UniformExpressions::enter(const Global& function) {
    first_ = function.first;
    locals_ = find_variables(text_, function.first, function.node);
    written_.clear();
    aliases_.clear();
    find_written(function.first, function.node);
    values_.assign(function.node - function.first + 1, std::nullopt);
    for (NodeId id = function.first; id <= function.node; ++id) { // children come before their parents
        if (is_expression(tree_[id].kind))
            values_[id - first_] = evaluate(id);
        else if (tree_[id].kind == NodeKind::declaration)
            find_aliases(id);
    }
}

auto UniformExpressions::value(NodeId expression) const -> Value {
    return expression >= first_ && expression - first_ < values_.size() ? values_[expression - first_]
                                                                        : std::nullopt;
}

auto UniformExpressions::alias(std::string_view name) const -> const Alias* {
    const auto found = aliases_.find(name);
    return found == aliases_.end() ? nullptr : &found->second;
}

std::optional<std::string> UniformExpressions::spelled(NodeId id, size_t longest, const Refused& refused,
                                                       int depth) const {
    std::string words;
    for (size_t i = tree_[id].begin; i < tree_[id].end; ++i) {
        const Word& word = text_.words()[i];
        const bool inside = i > tree_[id].begin;
        const bool member = inside && text_.words()[i - 1].is(".");
        const bool identifier = word.kind == text::TokenKind::identifier;
        const Alias* const known = identifier && !member ? alias(word.text) : nullptr;
        auto next = std::optional(std::string(word.text));
        if (known)
            next = depth < k_longest_alias_chain ? spelled(known->value, longest, refused, depth + 1)
                                                 : std::nullopt;
        if (!next || words.size() > longest || (identifier && refused(word.text, member)))
            return std::nullopt;
        if (known) // a whole number may become a float
            next = fmt::format("{}({})",
                               value(known->value)->type == known->type ? "" : to_string(known->type), *next);
        const bool operation = inside && is_operation(i);
        const bool sign = word.is("-") || word.is("+"); // `--` is another operator
        const bool apart = operation || words.ends_with(',') || (sign && words.ends_with(word.text));
        words += (apart ? " " : "") + *next + (operation ? " " : "");
    }
    return words;
}

/// Returns whether a token is an operator between two operands.
bool UniformExpressions::is_operation(size_t word) const {
    const Word& before = text_.words()[word - 1];
    const bool ends_value = before.kind != text::TokenKind::punctuation || before.is(")") || before.is("]");
    return ends_value && text_.words()[word].text.size() == 1 &&
           std::string_view("+-*/").find(text_.words()[word].text) != std::string_view::npos;
}

bool UniformExpressions::writes_through_arguments(std::string_view name) const {
    const auto found = functions_.find(name);
    if (found == functions_.end())
        return builtin_written_arguments(name) != 0;
    for (const Global* function : found->second)
        for (const NodeId part : tree_.children(function->node))
            if (tree_[part].kind == NodeKind::parameter) {
                const NodeId type = tree_.child(part, 0);
                if (has_qualifier(text_, type, "out") || has_qualifier(text_, type, "inout"))
                    return true;
            }
    return false;
}

void UniformExpressions::find_written(NodeId first, NodeId last) {
    const auto write = [&](NodeId target) {
        if (const NodeId base = base_of(tree_, target); tree_[base].kind == NodeKind::name)
            written_.insert(text_.word_of(base));
    };
    for (NodeId id = first; id <= last; ++id)
        if (is_change(text_, id))
            write(tree_.child(id, 0));
        else if (tree_[id].kind == NodeKind::call && writes_through_arguments(called_name(text_, id)))
            for (const NodeId argument : tree_.children(id))
                write(argument);
}

void UniformExpressions::find_aliases(NodeId declaration) {
    const NodeId type = tree_.child(declaration, 0);
    const auto numeric = value_type(type_name(text_, type));
    for (NodeId name = tree_[type].next; numeric && name != k_no_node; name = tree_[name].next) {
        const std::string_view word = text_.word_of(name);
        const NodeId initial = tree_.child(name, 0);
        if (initial == k_no_node || dimensions(text_, type, name) > 0 || locals_[word].times != 1 ||
            written_.contains(word) || globals_.contains(word) || functions_.contains(word))
            continue;
        const Value known = value(initial);
        if (known && (known->type == *numeric || (known->type.base == 'i' && numeric->base == 'f')))
            aliases_[word] = {initial, *numeric};
    }
}

/// Returns whether the name is the function in a call, which is not a value.
bool UniformExpressions::is_callee(NodeId name) const {
    const NodeId parent = tree_[name].parent;
    return tree_[parent].kind == NodeKind::call && tree_[parent].first_child == name;
}

auto UniformExpressions::evaluate(NodeId expression) const -> Value {
    const auto child = [&](size_t index) { return value(tree_.child(expression, index)); };
    switch (tree_[expression].kind) {
    case NodeKind::literal: {
        const auto type = type_of_literal(text_.word_of(expression));
        return type ? Value(FrameValue{*type}) : std::nullopt;
    }
    case NodeKind::name: return is_callee(expression) ? std::nullopt : name(text_.word_of(expression));
    case NodeKind::parenthesis: return child(0);
    case NodeKind::prefix: {
        const std::string_view op = text_.word_of(expression);
        return op == "-" || op == "+" ? child(0) : std::nullopt;
    }
    case NodeKind::binary: {
        const Value left = child(0);
        const Value right = child(1);
        if (!left || !right)
            return std::nullopt;
        const auto type = type_of_operation(text_.word_of(expression), left->type, right->type);
        return type ? Value({*type, left->uniform || right->uniform, left->costly || right->costly})
                    : std::nullopt;
    }
    case NodeKind::member: {
        const Value of = child(0);
        const auto type = of ? type_of_member(of->type, text_.word_of(expression)) : std::nullopt;
        return type ? Value({*type, of->uniform, of->costly}) : std::nullopt;
    }
    case NodeKind::call: return call(expression);
    default: return std::nullopt;
    }
}

auto UniformExpressions::name(std::string_view name) const -> Value {
    if (const Alias* known = alias(name)) {
        Value found = value(known->value);
        found->type = known->type;
        return found;
    }
    if (locals_.contains(name))
        return std::nullopt;
    const auto found = settled_.find(name);
    return found == settled_.end() ? std::nullopt : Value(found->second);
}

auto UniformExpressions::call(NodeId call) const -> Value {
    std::vector<ValueType> types;
    bool uniform = false;
    bool costly = false;
    const std::string_view callee = called_name(text_, call);
    if (callee.empty() || locals_.contains(callee))
        return std::nullopt;
    for (NodeId argument = tree_[tree_.child(call, 0)].next; argument != k_no_node;
         argument = tree_[argument].next) {
        const Value known = value(argument);
        if (!known)
            return std::nullopt;
        types.push_back(known->type);
        uniform = uniform || known->uniform;
        costly = costly || known->costly;
    }
    Value result = call_of(callee, types);
    if (result) {
        result->uniform = result->uniform || uniform;
        result->costly = result->costly || costly;
    }
    return result;
}

auto UniformExpressions::call_of(std::string_view callee, std::span<const ValueType> arguments) const
    -> Value {
    if (functions_.contains(callee)) {
        const auto pure = pure_function(callee);
        return pure ? Value({pure->type, pure->uniform, pure->costly}) : std::nullopt;
    }
    if (const auto built = value_type(callee))
        return FrameValue{*built};
    const BuiltinFunction* builtin = find_builtin(callee);
    const auto type = builtin && builtin->is(Trait::pure) ? type_of_call(*builtin, arguments) : std::nullopt;
    return type ? Value({*type, false, builtin->is(Trait::costly)}) : std::nullopt;
}

std::optional<PureFunction> UniformExpressions::pure_function(std::string_view name) const {
    const auto known = pure_.find(name);
    if (known != pure_.end())
        return known->second;
    pure_[name] = std::nullopt; // the result for a recursive call
    const Global* definition = nullptr;
    for (const Global* function : functions_.at(name))
        for (const NodeId part : tree_.children(function->node))
            if (tree_[part].kind == NodeKind::block) {
                if (definition)
                    return std::nullopt; // overloads
                definition = function;
            }
    if (!definition || writes_through_arguments(name) || functions_open_ >= k_deepest_calls)
        return std::nullopt;
    ++functions_open_;
    const auto pure = examine(*definition);
    --functions_open_;
    pure_[name] = pure;
    return pure;
}

/// Returns nothing unless every name is a local variable, constant during the frame, or a function that only
/// computes, and there is no loop: a loop might not end where the author does not call it.
std::optional<PureFunction> UniformExpressions::examine(const Global& function) const {
    const NodeId type = tree_.child(function.node, 0);
    const auto result = value_type(type_name(text_, type));
    if (!result || dimensions(text_, type, k_no_node) > 0)
        return std::nullopt;
    PureFunction pure{*result};
    const Variables locals = find_variables(text_, function.first, function.node);
    for (NodeId id = function.first; id <= function.node; ++id) {
        if (is_loop(tree_[id].kind) || (tree_[id].kind == NodeKind::jump && text_.word_of(id) == "discard"))
            return std::nullopt;
        if (tree_[id].kind == NodeKind::call && called_name(text_, id).empty())
            return std::nullopt;
        if (tree_[id].kind != NodeKind::name)
            continue;
        const std::string_view name = text_.word_of(id);
        if (!is_callee(id)) {
            const auto global = settled_.find(name);
            const bool settled = global != settled_.end();
            // A local variable's name may be a global one elsewhere in the function.
            const bool local = locals.contains(name) && !globals_.contains(name);
            if (!local && !settled && name != "true" && name != "false")
                return std::nullopt;
            pure.uniform = pure.uniform || (settled && global->second.uniform);
        } else if (functions_.contains(name)) {
            const auto called = pure_function(name);
            if (!called)
                return std::nullopt;
            pure.uniform = pure.uniform || called->uniform;
            pure.costly = pure.costly || called->costly;
        } else if (const BuiltinFunction* builtin = find_builtin(name); builtin && builtin->is(Trait::pure)) {
            pure.costly = pure.costly || builtin->is(Trait::costly);
        } else if (!value_type(name)) {
            return std::nullopt;
        }
    }
    return pure;
}

} // namespace tidemark::glsl
