// Counts the operations that a pixel executes: one counter for each run of statements without a branch.

#include "base/error.hpp"
#include "shader/builtin_functions.hpp"
#include "shader/lens_text.hpp"
#include "shader/lens_writer.hpp"
#include "shader/march_record.hpp"
#include "shader/variables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <map>
#include <utility>
#include <vector>

namespace tidemark::glsl {
namespace {

/// GLSL that counts the work of a pixel, in sixteenths.
constexpr std::string_view k_total_functions = R"(uint $work = 0u;
int $at(uint work) {
    $work += work;
    return 0;
}
)";
constexpr double k_parts_of_work = 16;
/// GLSL that counts how often a pixel runs each of four sites; `@` is the knob.
constexpr std::string_view k_site_functions = R"(vec4 $ran = vec4(0.0);
int $at(int site) {
    $ran += vec4(equal(ivec4(site) - 4 * int(@), ivec4(0, 1, 2, 3)));
    return 0;
}
)";

/// An operand that is not always evaluated is counted on its own from this work on.
constexpr double k_separate_work = 8;
/// Less work is not looked for among what was computed before.
constexpr double k_repeated_work = 4;

/// A built-in function as operations on each component, and once for the whole call.
struct Recipe {
    std::string_view name;
    double sums = 0; ///< for each component
    std::optional<Operation> each{}, each_too{}, once{};
};

/// Returns null for functions that count 1 for each component. Those that read textures are not here.
const Recipe* find_recipe(std::string_view name) {
    using enum Operation;
    static constexpr Recipe k_recipes[] = {
        {"sin", 0, sine},
        {"cos", 0, sine},
        {"tan", 0, sine, sine},
        {"asin", 10, root}, // as Mesa computes them
        {"acos", 11, root},
        {"atan", 0, arc},
        {"sinh", 1, exponential, exponential},
        {"cosh", 1, exponential, exponential},
        {"tanh", 2, exponential, quotient},
        {"asinh", 2, logarithm, root},
        {"acosh", 2, logarithm, root},
        {"atanh", 2, logarithm, quotient},
        {"pow", 0, power},
        {"exp", 0, exponential},
        {"exp2", 0, exponential},
        {"log", 0, logarithm},
        {"log2", 0, logarithm},
        {"sqrt", 0, root},
        {"inversesqrt", 0, inverse_root},
        {"floor", 0, rounding},
        {"ceil", 0, rounding},
        {"trunc", 0, rounding},
        {"round", 0, rounding},
        {"roundEven", 0, rounding},
        {"fract", 1, rounding},
        {"mod", 2, rounding, quotient},
        {"modf", 1, rounding},
        {"sign", 2},
        {"min", 0, extremum},
        {"max", 0, extremum},
        {"clamp", 0, extremum, extremum},
        {"mix", 3},
        {"fma", 2},
        {"smoothstep", 5, quotient, extremum},
        {"length", 2, {}, {}, root},
        {"distance", 3, {}, {}, root},
        {"dot", 2},
        {"cross", 3},
        {"normalize", 3, {}, {}, inverse_root},
        {"faceforward", 3},
        {"reflect", 4},
        {"refract", 6, {}, {}, root},
        {"determinant", 4},
        {"inverse", 8, {}, {}, quotient},
        {"fwidth", 3},
        {"floatBitsToInt", 0},
        {"floatBitsToUint", 0},
        {"intBitsToFloat", 0},
        {"uintBitsToFloat", 0},
    };
    const auto recipe = std::ranges::find(k_recipes, name, &Recipe::name);
    return recipe == std::end(k_recipes) ? nullptr : recipe;
}

double work_of_builtin(std::string_view name, double components, const WorkWeights& weights) {
    using enum Operation;
    if (name.starts_with("texelFetch"))
        return weights[fetch];
    if (name == "textureSize" || name == "textureQueryLevels")
        return weights[sum];
    if (name.starts_with("tex"))
        return weights[name.find("Lod") == name.npos ? lookup : lookup_level];
    const Recipe* const recipe = find_recipe(name);
    if (!recipe)
        return weights[sum] * components;
    double each = weights[sum] * recipe->sums;
    for (const auto& operation : {recipe->each, recipe->each_too})
        each += operation ? weights[*operation] : 0;
    return each * components + (recipe->once ? weights[*recipe->once] : 0);
}

/// Returns the number that a literal argument has. Compilers divide by it beforehand.
std::optional<double> literal_of(const ParsedText& text, NodeId id) {
    const NodeId inner = id == k_no_node ? id : without_brackets(text.tree(), id);
    if (inner == k_no_node || text.tree()[inner].kind != NodeKind::literal)
        return std::nullopt;
    const std::string word(text.word_of(inner));
    return std::strtod(word.c_str(), nullptr);
}

/// Returns the work of a call whose literal arguments make it cheaper than others; nullopt: they do not.
std::optional<double> work_with_literals(const ParsedText& text, NodeId call, double components,
                                         const WorkWeights& weights) {
    const std::string_view name = called_name(text, call);
    const auto argument = [&](size_t number) { return literal_of(text, text.tree().child(call, number)); };
    if (const auto power = argument(2);
        name == "pow" && power && *power == std::floor(*power) && *power > 0 && *power <= 4)
        return (*power - 1) * components;
    if (name == "pow" && argument(1))
        return (1 + weights[Operation::exponential]) * components;
    if (name == "mod" && argument(2))
        return (3 + weights[Operation::rounding]) * components;
    if (name == "smoothstep" && argument(1) && argument(2))
        return (5 + 2 * weights[Operation::extremum]) * components;
    return std::nullopt;
}

/// Returns the work of a product with a matrix; 0 for another operation.
double work_of_matrix(const ParsedText& text, const TreeFacts& facts, NodeId id) {
    const SyntaxTree& tree = text.tree();
    const std::string_view word = text.word_of(id);
    if (word != "*" && word != "*=")
        return 0;
    const auto left = expression_type(text, facts, tree.child(id, 0));
    const auto right = expression_type(text, facts, tree.child(id, 1));
    if (!left || !right || !(left->matrix() || right->matrix()) || left->scalar() || right->scalar())
        return 0;
    return 2.0 * (left->matrix() ? left->columns * left->rows * (right->matrix() ? right->columns : 1)
                                 : right->columns * right->rows);
}

/// Returns the work of one operation or call, without its operands. A constructor and `=` count nothing.
double work_of(const ParsedText& text, const TreeFacts& facts, NodeId id, const WorkWeights& weights) {
    const SyntaxTree& tree = text.tree();
    const std::string_view word = text.word_of(id);
    const auto size = [&](NodeId node) {
        const auto type = node == k_no_node ? std::nullopt : expression_type(text, facts, node);
        return type ? double(type->columns * type->rows) : 1.0;
    };
    switch (tree[id].kind) {
    case NodeKind::call: {
        const std::string_view name = called_name(text, id);
        if (facts.function(name))
            return weights[Operation::call];
        const double components = std::max(size(id), size(tree.child(id, 1)));
        if (!find_builtin(name))
            return 0;
        return work_with_literals(text, id, components, weights)
            .value_or(work_of_builtin(name, components, weights));
    }
    case NodeKind::assign:
        if (word == "=")
            return 0;
        [[fallthrough]];
    case NodeKind::prefix:
    case NodeKind::postfix:
    case NodeKind::binary:
    case NodeKind::conditional: break;
    default: return 0;
    }
    if (const double work = work_of_matrix(text, facts, id); work > 0)
        return work;
    const double components = std::max(size(id), size(tree.child(id, 0)));
    const bool divides = word == "/" || word == "/=" || word == "%" || word == "%=";
    if (!divides || literal_of(text, tree.child(id, 1)))
        return weights[Operation::sum] * components;
    // A vector is multiplied by the one inverse of a number.
    const double inverses = size(tree.child(id, 1));
    return weights[Operation::quotient] * inverses + weights[Operation::sum] * (components - inverses);
}

class WorkWriter : LensWriter {
public:
    WorkWriter(const ParsedText& text, const TreeFacts& facts, WorkAnswer answer, const WorkWeights& weights)
        : LensWriter(text, facts), answer_(answer), weights_(weights), needed_(find_needed(text, facts)),
          known_(find_known(text, facts, weights.device.empty() ? KnownTo::compilers : KnownTo::frame)),
          own_(tree_.nodes.size()), all_(tree_.nodes.size()) {}

    Result<WorkText> run() {
        TRY(check());
        weigh();
        result_.own.resize(tree_.nodes.size());
        result_.repeated.resize(tree_.nodes.size());
        result_.main_image = find_main_image(text_);
        for (const NodeId function : tree_.children(0))
            if (tree_[function].kind == NodeKind::function)
                if (const NodeId body = body_of_function(text_, function); body != k_no_node) {
                    block_ = result_.blocks.size();
                    computed_.clear();
                    result_.blocks.push_back({function});
                    statements(tree_.children(body));
                }
        const bool total = answer_ == WorkAnswer::total;
        const std::string answer =
            total ? fmt::format("$lens(vec4(float($work) / {:.1f}, 0.0, 0.0, 1.0), color)", k_parts_of_work)
                  : "$ran";
        result_.text =
            written(spell(total ? k_total_functions : k_site_functions, prefix_, k_sites_knob), answer);
        return std::move(result_);
    }

private:
    /// Work and calls of an expression that is evaluated whenever a site runs.
    struct Found {
        std::map<std::pair<std::string, int>, double> lines;
        std::vector<NodeId> calls;
        bool empty() const { return lines.empty() && calls.empty(); }
    };

    /// The work of each node, without and with the nodes inside it. Constants count nothing, nor does what
    /// nothing reads.
    void weigh() {
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) { // children come before their parents
            const NodeKind kind = tree_[id].kind;
            const bool runs = needed_[id] && !known_[id];
            own_[id] = is_expression(kind) && runs && !must_stay_constant(text_, id)
                           ? work_of(text_, facts_, id, weights_)
                           : 0;
            all_[id] = own_[id];
            calls_.push_back(runs && calls_authors_function(text_, facts_, id));
            for (const NodeId child : tree_.children(id)) {
                all_[id] += all_[child];
                calls_.back() = calls_.back() || calls_[child - 1];
            }
        }
    }

    /// Returns whether the expression is computed once if it is written twice: it has no effects and calls no
    /// function with a loop.
    bool is_plain(NodeId id) {
        for (NodeId each = id; each != k_no_node && tree_.is_within(each, id); --each) {
            if (!names_set(text_, facts_, each).empty() || is_loop(tree_[each].kind))
                return false;
            if (tree_[each].kind == NodeKind::call && calls(each))
                if (const FunctionFacts* const function = facts_.function(called_name(text_, each)))
                    for (const NodeId definition : function->definitions)
                        if (!is_plain_function(definition))
                            return false;
        }
        return true;
    }

    bool is_plain_function(NodeId definition) {
        const auto [found, is_new] = plain_.insert({definition, true});
        if (!is_new)
            return found->second;
        bool plain = true;
        for (NodeId id = definition - 1; plain && id != k_no_node && tree_.is_within(id, definition); --id) {
            plain = !is_loop(tree_[id].kind);
            for (const std::string_view name : names_set(text_, facts_, id))
                plain = plain && declares(definition, name);
            if (const FunctionFacts* const function =
                    tree_[id].kind == NodeKind::call ? facts_.function(called_name(text_, id)) : nullptr)
                for (const NodeId called : function->definitions)
                    plain = plain && is_plain_function(called);
        }
        return plain_[definition] = plain;
    }

    /// Returns whether the function has a variable of that name of its own.
    bool declares(NodeId function, std::string_view name) const {
        for (NodeId id = function - 1; id != k_no_node && tree_.is_within(id, function); --id)
            if ((tree_[id].kind == NodeKind::declarator || tree_[id].kind == NodeKind::parameter) &&
                text_.word_of(id) == name)
                return true;
        return false;
    }

    /// Returns whether the same expression was computed before and nothing that it reads has changed since;
    /// notes it otherwise.
    bool is_repeated(NodeId id) {
        const bool worth = all_[id] >= k_repeated_work || (tree_[id].kind == NodeKind::call && calls(id));
        if (!is_expression(tree_[id].kind) || !worth || !needed_[id] || !is_plain(id))
            return false;
        std::string words;
        std::vector<std::string_view> names;
        for (size_t word = tree_[id].begin; word < tree_[id].end; ++word) {
            words += std::string(text_.word(word)) + " ";
            names.push_back(text_.word(word));
        }
        // llvmpipe computes the sine and the cosine of a number together.
        if (weights_.both_sides && tree_[id].kind == NodeKind::call && called_name(text_, id) == "cos")
            words.replace(0, 3, "sin");
        return !computed_.try_emplace(std::move(words), std::move(names)).second;
    }

    void forget(std::string_view name) {
        std::erase_if(computed_, [&](const auto& each) {
            return std::ranges::find(each.second, name) != each.second.end();
        });
    }

    /// Forgets what reads a variable that the node or a node inside it sets or declares.
    void forget_changes(NodeId id) {
        for (NodeId each = id; each != k_no_node && tree_.is_within(each, id); --each) {
            for (const std::string_view name : names_set(text_, facts_, each))
                forget(name);
            if (tree_[each].kind == NodeKind::declarator)
                forget(text_.word_of(each));
        }
    }

    bool calls(NodeId id) const { return calls_[id - 1]; }

    /// Returns whether the operand is evaluated only in some cases, and worth a count of its own.
    bool is_separate(NodeId id, size_t index) const {
        const NodeId parent = tree_[id].parent;
        const std::string_view op = text_.word_of(parent);
        const bool maybe =
            (tree_[parent].kind == NodeKind::conditional && index > 0) ||
            (tree_[parent].kind == NodeKind::binary && (op == "&&" || op == "||") && index == 1);
        return maybe && (all_[id] >= k_separate_work || calls(id)) && !must_stay_constant(text_, id);
    }

    /// Returns the definition that a call means: by its number of arguments, then by their types.
    NodeId definition_of(NodeId call) const {
        const FunctionFacts* const function = facts_.function(called_name(text_, call));
        NodeId best = k_no_node;
        size_t most = 0;
        for (const NodeId definition : function ? function->definitions : std::vector<NodeId>{}) {
            const std::vector<NodeId> parameters = parameters_of(text_, definition);
            if (body_of_function(text_, definition) == k_no_node ||
                parameters.size() + 1 != tree_.child_count(call))
                continue;
            size_t fitting = 1;
            for (size_t i = 0; i < parameters.size(); ++i)
                fitting += expression_type(text_, facts_, tree_.child(call, i + 1)) ==
                           value_type(type_name(text_, tree_.child(parameters[i], 0)));
            if (fitting > most) {
                most = fitting;
                best = definition;
            }
        }
        return best;
    }

    void add_own(NodeId id, Found& found) {
        if (tree_[id].kind == NodeKind::call && calls(id) && needed_[id])
            if (const NodeId definition = definition_of(id); definition != k_no_node)
                found.calls.push_back(definition);
        if (own_[id] > 0)
            add_work(id, own_[id], found);
    }

    void add_work(NodeId id, double work, Found& found) {
        result_.own[id] += work;
        const SourceLocation where = text_.used(tree_[id].word);
        found.lines[{where.file, where.line}] += work;
    }

    /// Adds the work of an expression that is evaluated whenever the site runs.
    void expression(NodeId id, Found& found) {
        if (is_repeated(id)) {
            result_.repeated[id] = true;
            return;
        }
        size_t index = 0;
        for (const NodeId child : tree_.children(id)) {
            if (is_separate(child, index++)) {
                Found inside;
                expression(child, inside);
                edits_.wrap(child, fmt::format("({},", count(inside)), ")");
            } else {
                expression(child, found);
            }
        }
        add_own(id, found);
        for (const std::string_view name : names_set(text_, facts_, id))
            forget(name);
        if (tree_[id].kind == NodeKind::declarator)
            forget(text_.word_of(id));
        if (tree_[id].kind == NodeKind::call && calls(id) && !is_plain(id))
            computed_.clear(); // it may set global variables
    }

    /// Makes a site and returns the call that counts it.
    std::string count(const Found& found) {
        WorkSite site{.lines = {}, .block = block_, .calls = found.calls};
        for (const auto& [place, work] : found.lines)
            site.lines.push_back({{place.first, place.second}, work});
        result_.sites.push_back(std::move(site));
        return answer_ == WorkAnswer::total
                   ? fmt::format("{}at({}u)", prefix_,
                                 std::lround(k_parts_of_work * result_.sites.back().work()))
                   : fmt::format("{}at({})", prefix_, result_.sites.size() - 1);
    }

    static bool is_statement_with_parts(NodeKind kind) {
        return kind == NodeKind::if_else || kind == NodeKind::switch_on || kind == NodeKind::block ||
               is_loop(kind);
    }

    /// Returns whether control may leave the statement for a place after the next one.
    bool may_leave(NodeId id) const {
        for (size_t word = tree_[id].begin; word < tree_[id].end; ++word)
            for (const std::string_view jump : {"return", "break", "continue", "discard"})
                if (text_.word(word) == jump)
                    return true;
        return false;
    }

    /// Counts a list of statements: a new site begins after each that may leave the list.
    void statements(const std::vector<NodeId>& list) {
        Found found;
        NodeId first = k_no_node;
        const auto end_site = [&] {
            if (first != k_no_node && !found.empty())
                edits_.wrap(first, count(found) + ";", "");
            found = {};
            first = k_no_node;
        };
        for (const NodeId each : list) {
            if (tree_[each].kind == NodeKind::label) {
                end_site();
                continue;
            }
            if (first == k_no_node)
                first = each;
            statement(each, found);
            if (may_leave(each))
                end_site();
        }
        end_site();
    }

    /// Adds the work that the statement always does; counts its other parts on their own.
    void statement(NodeId id, Found& found) {
        switch (tree_[id].kind) {
        case NodeKind::block: return nested(id);
        case NodeKind::if_else:
            expression(tree_.child(id, 0), found);
            nested(tree_.child(id, 1));
            if (tree_.child_count(id) > 2)
                nested(tree_.child(id, 2));
            return;
        case NodeKind::switch_on:
            expression(tree_.child(id, 0), found);
            return statements(tree_.children(tree_.child(id, 1)));
        case NodeKind::loop_for:
            statement(tree_.child(id, 0), found);
            return loop(id, {tree_.child(id, 1), tree_.child(id, 2)});
        case NodeKind::loop_while:
        case NodeKind::loop_do: return loop(id, {head_of(tree_, id)});
        default: return expression(id, found);
        }
    }

    /// Counts the body of a loop together with `each`, what its head evaluates in each iteration.
    void loop(NodeId id, std::initializer_list<NodeId> each) {
        const size_t around = std::exchange(block_, result_.blocks.size());
        forget_changes(id);
        result_.blocks.push_back({k_no_node, around});
        Found head;
        for (const NodeId part : each)
            if (part != k_no_node)
                expression(part, head);
        if (weights_[Operation::iteration] > 0)
            add_work(id, weights_[Operation::iteration], head);
        nested(body_of(tree_, id), std::move(head), answer_ == WorkAnswer::sites);
        if (answer_ == WorkAnswer::sites)
            count_passes(id);
        block_ = around;
        forget_changes(id);
    }

    /// Counts how often a device with lanes runs the body of a loop: once more than it has iterations, if the
    /// condition at its head ends it.
    void count_passes(NodeId id) {
        const NodeId condition = tree_[id].kind == NodeKind::loop_do ? k_no_node : head_of(tree_, id);
        result_.blocks[block_].site = result_.sites.size();
        if (condition != k_no_node && is_expression(tree_[condition].kind) &&
            tree_[condition].kind != NodeKind::absent)
            edits_.wrap(condition, fmt::format("({},", count({})), ")");
        else
            edits_.wrap(body_of(tree_, id), "{" + count({}) + ";", "}");
    }

    /// Counts a part that does not always run; `more` is work that is done each time beside it.
    void nested(NodeId id, Found more = {}, bool always = false) {
        if (id == k_no_node)
            return;
        const auto before = computed_;
        if (tree_[id].kind == NodeKind::block)
            statements(tree_.children(id));
        else
            statement(id, more);
        computed_ = before;
        forget_changes(id);
        if (!more.empty() || always)
            edits_.wrap(id, "{" + count(more) + ";", "}");
    }

    WorkAnswer answer_;
    const WorkWeights& weights_;
    std::vector<bool> needed_, known_;
    std::vector<double> own_, all_;
    std::vector<bool> calls_; ///< from node 1 on
    /// Expressions whose values are known at this point of the function, with the words that they consist of.
    std::map<std::string, std::vector<std::string_view>> computed_;
    std::map<NodeId, bool> plain_; ///< functions of is_plain_function
    size_t block_ = 0;             ///< the block in which sites are made
    WorkText result_;
};

} // namespace

std::string_view to_string(Operation operation) {
    constexpr std::string_view k_names[] = {"sum",         "minimum",      "quotient",  "floor",
                                            "square root", "inverse root", "sine",      "arc",
                                            "exponential", "logarithm",    "power",     "texture read",
                                            "textureLod",  "texelFetch",   "iteration", "call"};
    static_assert(std::size(k_names) == k_operations);
    return k_names[size_t(operation)];
}

double WorkSite::work() const {
    double sum = 0;
    for (const auto& [place, work] : lines)
        sum += work;
    return sum;
}

Result<WorkText> count_operations(const ParsedText& text, const TreeFacts& facts, WorkAnswer answer,
                                  const WorkWeights& weights) {
    return WorkWriter(text, facts, answer, weights).run();
}

} // namespace tidemark::glsl
