// Varies a text as SwiftShader, the software driver of Chromium, computes it. The polynomials and the order
// of operations are those that its sources state (its folder src/Pipeline of 2026, built with
// SWIFTSHADER_LEGACY_PRECISION as Chromium does), written anew in GLSL;
// tests/gl/variation_gl_test.cpp compares them with numbers that Chromium computed.
#include "shader/builtin_functions.hpp"
#include "shader/loops.hpp"
#include "shader/source_edits.hpp"
#include "shader/variables.hpp"
#include "shader/variation.hpp"
#include "shader/watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tidemark::glsl {

// shader/swiftshader/*.glsl, compiled into the program (CMakeLists.txt).
extern const std::string_view k_swift_numbers, k_swift_vectors, k_swift_lookups, k_swift_cubes;

namespace {

struct SwiftFunction {
    std::string_view name;
    int parts;         ///< bits of SwiftShaderPart that change it
    int arguments = 0; ///< of a function that works on each component; 0: the prelude has its overloads
};

using enum SwiftShaderPart;
constexpr SwiftFunction k_swift_functions[] = {
    {"sin", int(sines), 1},
    {"cos", int(sines), 1},
    {"tan", int(sines), 1},
    {"asin", int(arcs), 1},
    {"acos", int(arcs), 1},
    {"atan", int(arcs) | int(outside), 2},
    {"exp", int(powers), 1},
    {"exp2", int(powers), 1},
    {"log", int(powers) | int(outside), 1},
    {"log2", int(powers) | int(outside), 1},
    {"pow", int(powers) | int(outside), 2},
    {"sinh", int(powers), 1},
    {"cosh", int(powers), 1},
    {"tanh", int(powers), 1},
    {"asinh", int(powers), 1},
    {"acosh", int(powers), 1},
    {"atanh", int(powers), 1},
    {"fract", int(products), 1},
    {"divide", int(products) | int(outside), 2}, // of the operator, too
    {"mod", int(products) | int(outside), 2},
    {"smoothstep", int(products) | int(outside), 3},
    {"min", int(outside), 2},
    {"max", int(outside), 2},
    {"clamp", int(outside), 3},
    {"dFdx", int(derivatives), 1},
    {"dFdy", int(derivatives), 1},
    {"fwidth", int(derivatives), 1},
    {"inverse", int(products)},
    {"determinant", int(products)},
    {"mix", int(products)},
    {"dot", int(products)},
    {"cross", int(products)},
    {"length", int(products)},
    {"distance", int(products)},
    {"normalize", int(products)},
    {"reflect", int(products)},
    {"refract", int(products)},
    {"texture", int(mipmaps) | int(weights)},
    {"textureLod", int(mipmaps) | int(weights)},
    {"textureGrad", int(mipmaps) | int(weights)},
    {"uint", int(outside)}, // of floats
    {"uvec2", int(outside)},
    {"uvec3", int(outside)},
    {"uvec4", int(outside)},
};

std::string replaced(std::string text, std::string_view what, std::string_view with) {
    for (size_t at = text.find(what); at != text.npos; at = text.find(what, at + with.size()))
        text.replace(at, what.size(), with);
    return text;
}

/// Returns overloads for vectors of functions that work on each component, and of those that do not.
std::string swift_overloads() {
    std::string text;
    const auto each = [&](std::string_view name, int size, int arguments, bool folds = false) {
        std::string parts;
        for (int i = 0; i < size; ++i)
            parts += fmt::format("{}${}(u[{}]{})", i > 0 ? "," : "", name, i,
                                 arguments == 1   ? ""
                                 : arguments == 2 ? fmt::format(",v[{}]", i)
                                                  : fmt::format(",v[{0}],w[{0}]", i));
        text += fmt::format("vec{0} ${1}(vec{0} u{2}){{{4}return vec{0}({3});}}\n", size, name,
                            arguments == 1   ? ""
                            : arguments == 2 ? fmt::format(",vec{} v", size)
                                             : fmt::format(",vec{0} v,vec{0} w", size),
                            parts,
                            !folds           ? ""
                            : arguments == 2 ? "u=$whole(u);v=$whole(v);"
                                             : "u=$whole(u);");
    };
    for (int size = 2; size <= 4; ++size) {
        for (const SwiftFunction& function : k_swift_functions)
            if (function.arguments > 0) {
                const bool folds = is_folded_by_swiftshader(function.name) || function.name == "divide";
                each(function.name, size, function.arguments, folds);
                if (function.name == "atan")
                    each(function.name, size, 1, folds);
            }
        each("across", size, 1);
        each("upwards", size, 1);
        std::string chain = "a[0]*b[0]", parts;
        for (int i = 1; i < size; ++i)
            chain = fmt::format("$fma(a[{0}],b[{0}],{1})", i, chain);
        for (int i = 0; i < size; ++i)
            parts += fmt::format("{0}a[{1}]?y[{1}]:x[{1}]", i > 0 ? "," : "", i);
        text += fmt::format("float $dot(vec{0} v,vec{0} w){{vec{0} a=$alone(v),b=$alone(w);"
                            "float r={1},u=dot(v,w);return $has(8)?r:u;}}\n"
                            "vec{0} $mix(vec{0} x,vec{0} y,bvec{0} a){{return vec{0}({2});}}\n",
                            size, chain, parts) +
                replaced(std::string(k_swift_vectors), "@", fmt::format("vec{}", size));
    }
    return text;
}

/// Returns functions that take whole numbers, too.
std::string swift_whole_overloads() {
    std::string text;
    for (const std::string_view type : k_vectors)
        text += fmt::format("{0} $later({0} v,{0} kept){{return ($mode>>20)!=0?kept:v;}}\n", type);
    for (const std::string_view type : k_whole_vectors.first<8>()) {
        const std::string_view one = type.find('u') != type.npos ? "uint" : "int";
        for (const std::string_view name : {"min", "max"})
            text +=
                fmt::format("{0} ${2}({0} a,{0} b){{return {2}(a,b);}}\n", type, one, name) +
                (type == one ? ""
                             : fmt::format("{0} ${2}({0} a,{1} b){{return {2}(a,b);}}\n", type, one, name));
        for (const std::string_view name : {"modulo", "quotient"})
            if (type != one) {
                text += fmt::format("{0} ${1}({0} a,{0} b){{{0} r;"
                                    "for(int i=0;i<a.length();++i)r[i]=${1}(a[i],b[i]);return r;}}\n",
                                    type, name);
                text += fmt::format("{0} ${2}({0} a,{1} b){{return ${2}(a,{0}(b));}}\n"
                                    "{0} ${2}({1} a,{0} b){{return ${2}({0}(a),b);}}\n",
                                    type, one, name);
            }
        text +=
            fmt::format("{0} $clamp({0} x,{0} a,{0} b){{return clamp(x,a,b);}}\n", type) +
            (type == one ? ""
                         : fmt::format("{0} $clamp({0} x,{1} a,{1} b){{return clamp(x,a,b);}}\n", type, one));
    }
    return text;
}

/// Returns the products of matrices and vectors: each number a chain of multiply-adds, both rounded.
std::string swift_matrices() {
    std::string text;
    for (int columns = 2; columns <= 4; ++columns)
        for (int rows = 2; rows <= 4; ++rows) {
            std::string left, right;
            for (int row = 0; row < rows; ++row) {
                std::string chain = fmt::format("m[0][{0}]*v[0]", row);
                for (int i = 1; i < columns; ++i)
                    chain = fmt::format("$fma(m[{0}][{1}],v[{0}],{2})", i, row, chain);
                left += (row > 0 ? "," : "") + chain;
            }
            for (int column = 0; column < columns; ++column)
                right += fmt::format("{}$dot(v,m[{}])", column > 0 ? "," : "", column);
            const std::string matrix = fmt::format("mat{}x{}", columns, rows);
            text += fmt::format(
                "vec{2} $times({0} m,vec{1} w){{vec{1} v=$alone(w);vec{2} r=vec{2}({3}),u=m*w;"
                "return $has(8)?r:u;}}\n"
                "vec{1} $times(vec{2} v,{0} m){{vec{1} r=vec{1}({4}),u=v*m;return $has(8)?r:u;}}\n"
                "{0} $times({0} m,float f){{return m*f;}}\n"
                "{0} $times(float f,{0} m){{return f*m;}}\n",
                matrix, columns, rows, left, right);
        }
    for (int columns = 2; columns <= 4; ++columns) // after the products with vectors, which these use
        for (int rows = 2; rows <= 4; ++rows)
            for (int others = 2; others <= 4; ++others) {
                std::string parts;
                for (int i = 0; i < others; ++i)
                    parts += fmt::format("{}$times(m,n[{}])", i > 0 ? "," : "", i);
                text +=
                    fmt::format("mat{2}x{1} $times(mat{0}x{1} m,mat{2}x{0} n){{return mat{2}x{1}({3});}}\n",
                                columns, rows, others, parts);
            }
    return text;
}

std::string swift_lookups() {
    const auto of = [](std::string_view sampler, std::string_view type, std::string_view corners,
                       std::string_view third) {
        std::string text(k_swift_lookups);
        for (const auto& [word, with] :
             {std::pair("SAMPLER", sampler), {"CORNERS", corners}, {"THIRD", third}, {"@", type}})
            text = replaced(std::move(text), word, with);
        return text;
    };
    return of("sampler2D", "vec2", "4", "") + of("sampler3D", "vec3", "8", ",i>>2") +
           std::string(k_swift_cubes);
}

const SwiftFunction* swift_function(const ParsedText& text, const TreeFacts& facts, NodeId id) {
    const std::string_view name =
        text.tree()[id].kind == NodeKind::call ? called_name(text, id) : std::string_view{};
    const auto found = std::ranges::find(k_swift_functions, name, &SwiftFunction::name);
    if (found == std::end(k_swift_functions) || facts.function(name))
        return nullptr;
    if (const auto made = value_type(name); made && made->base == 'u') { // a conversion
        const auto from = expression_type(text, facts, text.tree().child(id, 1));
        return from == ValueType{'f', made->columns, made->rows} ? found : nullptr;
    }
    return found;
}

/// Returns whether the expression has no side effects and is short enough to be repeated.
bool is_repeatable(const ParsedText& text, const TreeFacts& facts, NodeId id) {
    const SyntaxTree& tree = text.tree();
    switch (tree[id].kind) {
    case NodeKind::name: return !facts.is_type(text.word_of(id));
    case NodeKind::member: return is_repeatable(text, facts, tree.child(id, 0));
    case NodeKind::index: {
        const NodeKind index = tree[tree.child(id, 1)].kind;
        return (index == NodeKind::name || index == NodeKind::literal) &&
               is_repeatable(text, facts, tree.child(id, 0));
    }
    default: return false;
    }
}

/// Returns whether the node reads or writes an element whose number is known only at run time. Chromium keeps
/// such a number within the array, vector or matrix.
bool is_element(const ParsedText& text, const TreeFacts& facts, NodeId id) {
    const SyntaxTree& tree = text.tree();
    if (tree[id].kind != NodeKind::index || tree.around(id, NodeKind::function) == k_no_node)
        return false;
    const NodeId number = tree.child(id, 1);
    if (number == k_no_node || tree[number].kind == NodeKind::literal ||
        !is_repeatable(text, facts, tree.child(id, 0)))
        return false;
    const auto type = expression_type(text, facts, number);
    return type && type->scalar() && (type->base == 'i' || type->base == 'u');
}

bool is_scalar(const ParsedText& text, const TreeFacts& facts, NodeId id) {
    const auto type = expression_type(text, facts, id);
    return type && type->scalar();
}

/// Returns the function of the prelude for a product of a matrix, a quotient or a remainder; empty for other
/// nodes. `known` may be null: `divide` then stands for `over`, too.
std::string_view swift_operator(const ParsedText& text, const TreeFacts& facts,
                                const std::vector<bool>* known, NodeId id) {
    const SyntaxTree& tree = text.tree();
    if (tree[id].kind != NodeKind::binary && tree[id].kind != NodeKind::assign)
        return {};
    const std::string_view word = text.word_of(id);
    const bool times = word == "*" || word == "*=";
    const bool modulo = word == "%" || word == "%=";
    if (!times && !modulo && word != "/" && word != "/=")
        return {};
    const auto left = expression_type(text, facts, tree.child(id, 0));
    const auto right = expression_type(text, facts, tree.child(id, 1));
    if (left && right && left->base == right->base && (left->base == 'i' || left->base == 'u')) {
        if (modulo)
            return "modulo";
        return times || tree[without_brackets(tree, tree.child(id, 1))].kind == NodeKind::literal
                   ? std::string_view{}
                   : "quotient";
    }
    if (modulo)
        return {};
    if (!left || !right || left->base != 'f' || right->base != 'f')
        return {};
    if (left->matrix() || right->matrix())
        return times ? "times" : std::string_view{};
    if (times)
        return {};
    return known && (*known)[tree.child(id, 1)] ? "over" : "divide";
}

/// Returns whether the node divides by a literal number and has a known factor: times the reciprocal, which
/// the driver merges with that factor as SPIRV-Tools does.
bool has_merged_reciprocal(const ParsedText& text, const TreeFacts& facts, const std::vector<bool>& known,
                           NodeId id) {
    const SyntaxTree& tree = text.tree();
    const auto has_factor = [&](NodeId product) {
        return tree[product].kind == NodeKind::binary && text.word_of(product) == "*" &&
               (known[tree.child(product, 0)] || known[tree.child(product, 1)]);
    };
    const NodeId divisor = without_brackets(tree, tree.child(id, 1));
    const bool is_number = tree[divisor].kind == NodeKind::literal &&
                           text.word_of(divisor).find_first_of("123456789") != std::string_view::npos;
    return is_number && is_scalar(text, facts, tree.child(id, 0)) &&
           (has_factor(without_brackets(tree, tree.child(id, 0))) || has_factor(tree[id].parent));
}

int operator_parts(std::string_view name) {
    if (name == "modulo" || name == "quotient")
        return int(outside);
    return int(products) | (name == "times" ? 0 : int(outside)); // by zero
}

/// Returns whether the node is a product or a quotient with a known factor, or a sum with a known term.
bool has_known_operand(const ParsedText& text, const std::vector<bool>& known, NodeId id, bool is_sum) {
    const SyntaxTree& tree = text.tree();
    id = without_brackets(tree, id);
    const std::string_view words = is_sum ? "+-" : "*/";
    return tree[id].kind == NodeKind::binary && words.find(text.word_of(id)) != words.npos &&
           known[tree.child(id, 0)] != known[tree.child(id, 1)];
}

/// Returns whether SPIRV-Tools merges nothing of a float operation's operands with it: it merges a constant
/// with one of the other operand, and constants of both operands, but no scalar factor of a vector.
bool is_apart(const ParsedText& text, const TreeFacts& facts, const std::vector<bool>& known, NodeId id) {
    const SyntaxTree& tree = text.tree();
    const std::string_view word = text.word_of(id);
    constexpr std::string_view k_words[] = {"+", "-", "*", "+=", "-=", "*="};
    if ((tree[id].kind != NodeKind::binary && tree[id].kind != NodeKind::assign) ||
        std::ranges::find(k_words, word) == std::end(k_words))
        return false;
    const NodeId left = tree.child(id, 0), right = tree.child(id, 1);
    const auto of_left = expression_type(text, facts, left), of_right = expression_type(text, facts, right);
    if (!of_left || !of_right || of_left->base != 'f' || of_right->base != 'f' || of_left->matrix() ||
        of_right->matrix() || (tree[id].kind == NodeKind::assign && !is_repeatable(text, facts, left)))
        return false;
    const bool is_scaled = word.front() == '*' && of_left->scalar() != of_right->scalar();
    if (is_scaled)
        return true;
    const bool is_sum = word.front() != '*';
    return !known[left] && !known[right] &&
           !(has_known_operand(text, known, left, is_sum) && has_known_operand(text, known, right, is_sum));
}

/// Returns the operand of a float sum or product with a known operand that SPIRV-Tools cannot merge with it,
/// since it is an operation without a known operand. k_no_node: it may merge it.
NodeId operand_apart(const ParsedText& text, const TreeFacts& facts, const std::vector<bool>& known,
                     NodeId id) {
    const SyntaxTree& tree = text.tree();
    const std::string_view word = text.word_of(id);
    if (tree[id].kind != NodeKind::binary || (word != "+" && word != "-" && word != "*") ||
        known[tree.child(id, 0)] == known[tree.child(id, 1)])
        return k_no_node;
    const NodeId operand = tree.child(id, known[tree.child(id, 0)] ? 1 : 0);
    const auto type = expression_type(text, facts, operand);
    return type && type->base == 'f' && !type->matrix() &&
                   tree[without_brackets(tree, operand)].kind == NodeKind::binary &&
                   !has_known_operand(text, known, operand, word != "*")
               ? operand
               : k_no_node;
}

/// Returns whether the value and the lower bound of a `clamp` are known. The compiler ignores the upper one.
bool is_known_below(const ParsedText& text, const TreeFacts& facts, const std::vector<bool>& known,
                    NodeId id) {
    if (text.tree()[id].kind != NodeKind::call || called_name(text, id) != "clamp")
        return false;
    const auto type = expression_type(text, facts, id);
    return type && type->base == 'f' && known[text.tree().child(id, 1)] && known[text.tree().child(id, 2)];
}

/// Returns whether Chromium's compiler computes a call of the function, of constants, with other bits than
/// Mesa's does.
bool is_exact(const ParsedText& text, const TreeFacts& facts, const SwiftFunction& function, NodeId id) {
    const bool scalar = is_scalar(text, facts, id);
    if (function.name == "normalize")
        return !scalar;
    return scalar && ((function.parts & int(arcs)) != 0 || function.name == "tan");
}

/// Rewrites one text.
class SwiftRewriter {
public:
    SwiftRewriter(const ParsedText& text, const TreeFacts& facts, int parts, SwiftOrder order,
                  const MayVary& may)
        : text_(text), facts_(facts), tree_(text.tree()), parts_(parts), order_(order), may_(may),
          prefix_(fresh_prefix(text)), known_(find_known(text, facts, KnownTo::swiftshader)),
          reads_(reads_before_settings(text, facts)), functions_(tree_.nodes.size()),
          edits_(text), result_{{}, prefix_ + "mode", {}, prefix_ + "filters"} {
        for (NodeId id = 1; id < tree_.nodes.size(); ++id)
            if ((functions_[id] = swift_function(text, facts, id)))
                all_parts_ |= functions_[id]->parts;
    }

    Variation rewrite() {
        const std::vector<NodeId> unknown = find_unknown(text_, facts_, known_);
        if ((all_parts_ & parts_ & k_of_neighbours) != 0)
            keep_loop_variables();
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) { // children first, as SourceRewriter asks for
            // Hiding an operand that is read last would read it first.
            if (std::ranges::binary_search(unknown, id) && !std::ranges::binary_search(reads_.late, id) &&
                !must_stay_constant(text_, id))
                edits_.wrap(id, ours("hidden("), ")");
            if (const auto found = in_loops_.find(id); found != in_loops_.end())
                edits_.wrap(id, found->second.first, found->second.second);
            if (may_ && !may_(id))
                continue;
            if (order_ == SwiftOrder::text && make_precise(text_, id, edits_))
                result_.places.push_back(id);
            if (!must_stay_constant(text_, id) && vary(id))
                result_.places.push_back(id);
        }
        result_.text = headers_with_buffers(text_) + prelude() + copies_ + edits_.text();
        return std::move(result_);
    }

private:
    /// Parts in which a pixel's value depends on its neighbours'.
    static constexpr int k_of_neighbours = int(mipmaps) | int(derivatives);

    std::string ours(std::string_view name) const { return prefix_ + std::string(name); }

    /// A pixel that has left a loop takes part in its neighbours' derivatives with what its variables were
    /// when its last iteration began; llvmpipe would take what they were when it left.
    void keep_loop_variables() {
        for (const LeftLoop& loop : left_loops(text_, facts_)) {
            std::string begin, end;
            for (const auto& [name, type] : loop.variables) {
                const std::string kept = ours("kept_") + replaced(name, ".", "_of_");
                begin += fmt::format("{} {}={};", to_string(type), kept, name);
                end += fmt::format("{}={}later({},{});", name, prefix_, name, kept);
            }
            in_loops_[loop.body] = {"{" + begin, end + "}"};
            for (const NodeId statement : loop.continues)
                in_loops_[statement] = {"{" + end, "}"};
        }
    }

    /// Edits the node. Returns whether it is a place.
    bool vary(NodeId id) {
        const SwiftFunction* const function = functions_[id];
        if (known_[id]) {
            if ((parts_ & int(arcs)) == 0 || !function || !is_exact(text_, facts_, *function, id))
                return false;
            edits_.replace(tree_[tree_.child(id, 0)].word, ours("exact_") + std::string(function->name));
            return true;
        }
        bool place = true;
        if (function && (function->parts & parts_) != 0) {
            vary_call(id, *function);
        } else if (const auto name = swift_operator(text_, facts_, &known_, id);
                   !name.empty() && (parts_ & operator_parts(name)) != 0) {
            place = vary_operator(id, name);
        } else if ((parts_ & int(outside)) != 0 && is_element(text_, facts_, id)) {
            vary_element(id);
        } else {
            place = false; // what is kept apart has its value
            if (order_ == SwiftOrder::compiler)
                keep_apart(id);
        }
        return keep_early(id) || place;
    }

    void vary_call(NodeId id, const SwiftFunction& function) {
        const auto name = is_known_below(text_, facts_, known_, id) ? "bound" : function.name;
        edits_.replace(tree_[tree_.child(id, 0)].word, ours(name));
        has_lookup_ = has_lookup_ || (function.parts & (int(mipmaps) | int(weights))) != 0;
        if (function.name.starts_with("texture") && tree_.child_count(id) > 2)
            edits_.wrap(tree_.child(id, 2),
                        fmt::format("{}via({},", prefix_, channels_of(text_, facts_, tree_.child(id, 1))),
                        ")");
    }

    /// Returns whether the operator is a place; one that the driver computes alike stays.
    bool vary_operator(NodeId id, std::string_view name) {
        const bool assigns = tree_[id].kind == NodeKind::assign;
        if (name == "over" && order_ == SwiftOrder::compiler && is_scalar(text_, facts_, id)) {
            // No mode undoes it: a choice would keep the driver from merging the reciprocal.
            edits_.replace(tree_[id].word, assigns ? "*=" : "*");
            edits_.wrap(tree_.child(id, 1), "(1.0/(", "))");
            return true;
        }
        if (name == "over" && has_merged_reciprocal(text_, facts_, known_, id))
            return false;
        has_matrix_ = has_matrix_ || name == "times";
        edits_.wrap(id, ours(name) + "(", ")");
        if (assigns)
            edits_.wrap(id, "(" + words_of(text_, tree_.child(id, 0)) + "=", ")");
        edits_.replace(tree_[id].word, ",");
        return true;
    }

    void vary_element(NodeId id) {
        if ((all_parts_ & k_of_neighbours) != 0 && is_number_read(text_, facts_, id))
            edits_.wrap(id, ours("kept("), ")");
        edits_.wrap(tree_.child(id, 1), ours("place("),
                    fmt::format(",({}).length())", words_of(text_, tree_.child(id, 0))));
    }

    /// Hides operands from the driver where it would merge more than SPIRV-Tools does.
    void keep_apart(NodeId id) {
        const std::string alone = ours("alone(");
        if (!is_apart(text_, facts_, known_, id)) {
            if (const NodeId operand = operand_apart(text_, facts_, known_, id); operand != k_no_node)
                edits_.wrap(operand, alone, ")");
            return;
        }
        const NodeId left = tree_.child(id, 0), right = tree_.child(id, 1);
        if (tree_[id].kind == NodeKind::binary) {
            for (const NodeId operand : {left, right})
                if (!known_[operand])
                    edits_.wrap(operand, alone, ")");
        } else {
            edits_.replace(tree_[id].word,
                           fmt::format("={}{}){}", alone, words_of(text_, left), text_.word_of(id).front()));
            edits_.wrap(right, known_[right] ? "(" : alone, ")");
        }
    }

    bool keep_early(NodeId id) {
        if ((parts_ & int(SwiftShaderPart::order)) == 0 || !std::ranges::binary_search(reads_.early, id))
            return false;
        const std::string copy = fmt::format("{}early{}", prefix_, id);
        copies_ += fmt::format("{} {};\n", to_string(*expression_type(text_, facts_, id)), copy);
        edits_.wrap(id, fmt::format("({}=", copy), ")");
        return true;
    }

    std::string prelude() const {
        std::string text = "#extension GL_ARB_gpu_shader5 : enable\n"
                           "#extension GL_ARB_gpu_shader_fp64 : enable\n"
                           "#extension GL_ARB_derivative_control : enable\n"
                           "#extension GL_ARB_texture_query_levels : enable\n";
        std::string alone; // uses $mode, which k_swift_numbers declares
        if (order_ != SwiftOrder::compiler)
            text += spell("#define $alone(v) (v)\n", prefix_);
        else
            for (const std::string_view type : k_float_vectors) {
                text += spell("@ $alone(@ v);\n", prefix_, type);
                alone += spell("@ $alone(@ v){return intBitsToFloat(floatBitsToInt(v)^($mode>>20));}\n",
                               prefix_, type);
            }
        text += spell(std::string(k_swift_numbers), prefix_) + alone;
        text += spell(swift_overloads() + swift_whole_overloads() + (has_matrix_ ? swift_matrices() : "") +
                          (has_lookup_ ? swift_lookups() : ""),
                      prefix_);
        return order_ == SwiftOrder::compiler ? replaced(std::move(text), "precise ", "") : text;
    }

    const ParsedText& text_;
    const TreeFacts& facts_;
    const SyntaxTree& tree_;
    int parts_;
    SwiftOrder order_;
    const MayVary& may_;
    std::string prefix_;
    std::vector<bool> known_;
    ReadsBeforeSettings reads_;
    std::vector<const SwiftFunction*> functions_; ///< of each node; null: none
    int all_parts_ = 0;                           ///< of the text's functions
    bool has_lookup_ = false, has_matrix_ = false;
    std::string copies_; ///< variables that keep what is read early
    /// Texts to insert around bodies of loops and `continue`.
    std::map<NodeId, std::pair<std::string, std::string>> in_loops_;
    SourceRewriter edits_;
    Variation result_;
};

} // namespace

Variation vary_like_swiftshader(const ParsedText& text, const TreeFacts& facts, int parts, SwiftOrder order,
                                const MayVary& may) {
    return SwiftRewriter(text, facts, parts, order, may).rewrite();
}

std::vector<int> swiftshader_parts(const ParsedText& text, const TreeFacts& facts) {
    std::vector<int> result(text.tree().nodes.size());
    const std::vector<bool> known = find_known(text, facts, KnownTo::swiftshader);
    for (NodeId id = 1; id < result.size(); ++id) {
        const std::string_view name = swift_operator(text, facts, nullptr, id);
        if (const SwiftFunction* const function = swift_function(text, facts, id))
            result[id] = known[id] && is_exact(text, facts, *function, id) ? int(arcs) : function->parts;
        else if (is_element(text, facts, id))
            result[id] = int(outside);
        else if (!name.empty())
            result[id] = operator_parts(name);
    }
    for (const NodeId id : reads_before_settings(text, facts).early)
        result[id] |= int(order);
    return result;
}

} // namespace tidemark::glsl
