#include "shader/variation.hpp"

#include "shader/builtin_functions.hpp"
#include "shader/source_edits.hpp"
#include "shader/undefined_behaviour.hpp"
#include "shader/watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

namespace tidemark::glsl {
namespace {

constexpr std::string_view k_unit =
    R"(uniform int $mode;
float $unit(float v,int by){uint b=floatBitsToUint(v);
return (b&0x7fffffffu)==0u||(b&0x7f800000u)==0x7f800000u?v:uintBitsToFloat(uint(int(b)+by));}
)";

/// 0.15915494 and 6.2831855 are the binary32 numbers nearest to 1 / 2 pi and 2 pi.
constexpr std::string_view k_sine =
    R"(float $@(float x){float r=@(x);
return $mode==1?$unit(r,1):$mode==2?$unit(r,-1):$mode==3?
floor(@(6.2831855*fract(x*0.15915494))*4194304.0+0.5)/4194304.0:r;}
)";

constexpr std::string_view k_input = "float $input(float v){return $mode==0?v:$unit(v,1);}\n";

/// Flips the last bit if the eighth bit from the end is set. That is as good as chance but always the same,
/// and leaves whole numbers, halves, zeros and infinities, which are exact on any GPU. It costs three
/// instructions, because it follows every operation.
constexpr std::string_view k_lot =
    "float $off(float v){uint b=floatBitsToUint(v);return uintBitsToFloat(b^((b>>7u)&uint($mode)));}\n";

/// Rounds to the nearest half, ties to even. Halves have fewer bits below 2^-14; here those bits are kept.
constexpr std::string_view k_half =
    R"(float $off(float v){uint b=floatBitsToUint(v);
if($mode==0||(b&0x7f800000u)==0x7f800000u)return v;
float h=uintBitsToFloat((b+0xfffu+((b>>13u)&1u))&0xffffe000u);
return abs(h)>65504.0?uintBitsToFloat((b&0x80000000u)|0x7f800000u):h;}
)";

/// Returns overloads of a function of one float that apply it to each component.
std::string vector_overloads(std::string_view function, std::string_view prefix) {
    std::string text;
    for (int size = 2; size <= 4; ++size) {
        std::string parts;
        for (int i = 0; i < size; ++i)
            parts += fmt::format("{}{}{}(v[{}])", i > 0 ? "," : "", prefix, function, i);
        text +=
            fmt::format("vec{0} {1}{2}(vec{0} v){{return vec{0}({3});}}\n", size, prefix, function, parts);
    }
    return text;
}

/// Returns overloads for the other result types: matrices column by column, the rest unchanged.
std::string other_overloads(std::string_view function, std::string_view prefix) {
    std::string text;
    for (int columns = 2; columns <= 4; ++columns)
        for (int rows = 2; rows <= 4; ++rows) {
            std::string parts;
            for (int i = 0; i < columns; ++i)
                parts += fmt::format("{}{}{}(v[{}])", i > 0 ? "," : "", prefix, function, i);
            text += fmt::format("mat{0}x{1} {2}{3}(mat{0}x{1} v){{return mat{0}x{1}({4});}}\n", columns, rows,
                                prefix, function, parts);
        }
    for (const std::string_view type : k_whole_vectors)
        text += fmt::format("{0} {1}{2}({0} v){{return v;}}\n", type, prefix, function);
    return text;
}

/// Returns the text with the changes of `change(node, edits)` at the nodes that `may` change, children first;
/// `change` returns whether it changed anything.
template <class Change>
Variation vary(const ParsedText& text, const MayVary& may, const std::string& mode,
               const std::string& prelude, Change change) {
    Variation result{{}, mode, {}};
    SourceRewriter edits(text);
    for (NodeId id = 1; id < text.tree().nodes.size(); ++id)
        if ((!may || may(id)) && change(id, edits))
            result.places.push_back(id);
    result.text = headers_with_buffers(text) + prelude + edits.text();
    return result;
}

/// Passes the result of each operation, assignment or call that `is_meant` accepts through `$off`.
template <class IsMeant>
Variation vary_results(const ParsedText& text, const MayVary& may, std::string_view off, IsMeant is_meant) {
    const SyntaxTree& tree = text.tree();
    const std::string prefix = fresh_prefix(text);
    const std::string prelude = spell("uniform int $mode;\n", prefix) + spell(off, prefix) +
                                vector_overloads("off", prefix) + other_overloads("off", prefix);
    return vary(text, may, prefix + "mode", prelude, [&](NodeId id, SourceRewriter& edits) {
        if (!is_meant(id) || must_stay_constant(text, id))
            return false;
        if (tree[id].kind != NodeKind::assign) {
            edits.wrap(id, prefix + "off(", ")");
        } else {
            const std::string target = words_of(text, tree.child(id, 0));
            edits.wrap(id, "(", fmt::format(",{}={}off({}))", target, prefix, target));
        }
        return true;
    });
}

/// Returns whether the node is float arithmetic by an operator.
bool is_operation(const ParsedText& text, const TreeFacts& facts, NodeId id) {
    return text.tree()[id].kind != NodeKind::call && is_float_operation(text, facts, id);
}

// A product in a sum, `$sum($product(a,b),c)`, is passed in double: exact in mode 1, rounded in mode 0. The
// driver selects the overload by type; those where nothing is contracted (whole numbers, products of
// matrices) add and multiply as usual.

/// Joins `make(left, right, result)` for the sizes that an operator takes.
template <class Make>
std::string for_sizes(Make make) {
    std::string text;
    for (int left = 1; left <= 4; ++left)
        for (int right = 1; right <= 4; ++right)
            if (left == right || left == 1 || right == 1)
                text += make(left, right, std::max(left, right));
    return text;
}

std::string float_overloads() {
    return for_sizes([](int left, int right, int result) {
        const auto single = [](int size) { return k_float_vectors[size_t(size) - 1]; };
        const auto wide = [&](int size) { return double_type_of(single(size)); };
        return fmt::format("{5} $product({0} a,{1} b){{return $mode==1?{3}(a)*{4}(b):{5}(a*b);}}\n"
                           "{2} $sum({3} a,{1} b){{return {2}(a+{4}(b));}}\n"
                           "{2} $sum({0} a,{4} b){{return {2}({3}(a)+b);}}\n"
                           "{2} $sum({0} a,{1} b){{return a+b;}}\n",
                           single(left), single(right), single(result), wide(left), wide(right),
                           wide(result));
    });
}

std::string plain(std::string_view name, std::string_view left, char op, std::string_view right,
                  std::string_view result) {
    return fmt::format("{0} ${1}({2} a,{3} b){{return a{4}b;}}\n", result, name, left, right, op);
}

std::string whole_overloads() {
    std::string text;
    for (const size_t kind : {0, 4})
        text += for_sizes([&](int left, int right, int result) {
            const auto whole = [&](int size) { return k_whole_vectors[kind + size_t(size) - 1]; };
            return plain("product", whole(left), '*', whole(right), whole(result)) +
                   plain("sum", whole(left), '+', whole(right), whole(result));
        });
    return text;
}

std::string matrix_overloads() {
    std::string text;
    const auto matrix = [](int columns, int rows) { return fmt::format("mat{}x{}", columns, rows); };
    for (int columns = 2; columns <= 4; ++columns)
        for (int rows = 2; rows <= 4; ++rows) {
            const std::string type = matrix(columns, rows);
            const auto row = k_float_vectors[size_t(columns) - 1], column = k_float_vectors[size_t(rows) - 1];
            for (const auto& [name, op] : {std::pair("product", '*'), std::pair("sum", '+')})
                text += plain(name, type, op, "float", type) + plain(name, "float", op, type, type);
            text += plain("product", type, '*', row, column) + plain("product", column, '*', type, row) +
                    plain("sum", type, '+', type, type) +
                    fmt::format("{0} $sum({0} a,double b){{return a+float(b);}}\n"
                                "{0} $sum(double a,{0} b){{return float(a)+b;}}\n",
                                type);
            for (int others = 2; others <= 4; ++others)
                text += plain("product", type, '*', matrix(others, columns), matrix(others, rows));
        }
    return text;
}

/// The first product is rounded; the others are added with one rounding each.
std::string dot_overloads() {
    std::string text = "float $dot(float a,float b){return a*b;}\n";
    for (int size = 2; size <= 4; ++size) {
        std::string chain = "a[0]*b[0]";
        for (int i = 1; i < size; ++i)
            chain = fmt::format("float(double(a[{0}])*double(b[{0}])+double({1}))", i, chain);
        text += fmt::format("float $dot(vec{0} a,vec{0} b){{return $mode==1?{1}:dot(a,b);}}\n", size, chain);
    }
    return text;
}

std::string contraction_prelude(const ParsedText& text) {
    std::string prelude = "uniform int $mode;\n" + float_overloads() + whole_overloads() + dot_overloads();
    if (std::ranges::any_of(text.words(), [](const Word& word) { return word.text.starts_with("mat"); }))
        prelude += matrix_overloads();
    return prelude;
}

/// Returns the product that an operand consists of; k_no_node: it is something else.
NodeId product_of(const ParsedText& text, const TreeFacts& facts, NodeId operand) {
    const SyntaxTree& tree = text.tree();
    operand = without_brackets(tree, operand);
    const bool is_product = tree[operand].kind == NodeKind::binary && text.word_of(operand) == "*";
    return is_product && !facts.surely_whole[operand] ? operand : k_no_node;
}

class Contraction {
public:
    Contraction(const ParsedText& text, const TreeFacts& facts, const std::string& prefix,
                SourceRewriter& edits)
        : text_(text), tree_(text.tree()), facts_(facts), prefix_(prefix), edits_(edits) {}

    /// Returns whether the node was changed.
    bool contract(NodeId id) {
        if (must_stay_constant(text_, id))
            return false;
        switch (tree_[id].kind) {
        case NodeKind::call: return dot(id);
        case NodeKind::binary: return sum(id);
        case NodeKind::assign: return added(id);
        default: return false;
        }
    }

private:
    bool dot(NodeId id) {
        if (called_name(text_, id) != "dot" || facts_.function("dot"))
            return false;
        edits_.replace(tree_[tree_.child(id, 0)].word, prefix_ + "dot");
        return true;
    }

    /// Compilers contract one of two products; here it is the left one.
    bool sum(NodeId id) {
        const std::string_view op = text_.word_of(id);
        if ((op != "+" && op != "-") || !is_float_operation(text_, facts_, id))
            return false;
        const NodeId right = tree_.child(id, 1);
        const NodeId left_product = product_of(text_, facts_, tree_.child(id, 0));
        const NodeId product = left_product != k_no_node ? left_product : product_of(text_, facts_, right);
        if (product == k_no_node)
            return false;
        hand_over(product);
        edits_.replace(tree_[id].word, ",");
        if (op == "-")
            edits_.wrap(right, "-(", ")");
        edits_.wrap(id, prefix_ + "sum(", ")");
        return true;
    }

    /// Contracts `x += a * b`.
    bool added(NodeId id) {
        const std::string_view op = text_.word_of(id);
        if ((op != "+=" && op != "-=") || !is_float_operation(text_, facts_, id))
            return false;
        const NodeId value = tree_.child(id, 1);
        const NodeId product = product_of(text_, facts_, value);
        if (product == k_no_node)
            return false;
        hand_over(product);
        edits_.replace(tree_[id].word,
                       fmt::format("={}sum({},", prefix_, words_of(text_, tree_.child(id, 0))));
        edits_.wrap(value, op == "-=" ? "-(" : "(", "))");
        return true;
    }

    void hand_over(NodeId product) {
        edits_.wrap(product, prefix_ + "product(", ")");
        edits_.replace(tree_[product].word, ",");
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    const std::string& prefix_;
    SourceRewriter& edits_;
};

bool adds(const ParsedText& text, NodeId id) {
    return text.tree()[id].kind == NodeKind::binary && (text.word_of(id) == "+" || text.word_of(id) == "-");
}

/// Rewrites `a - b + c` as `a - (b - c)`: the mirror image of ((c - b) + a), with the same bits. Side effects
/// of the operands keep the order of the text.
void reverse(const ParsedText& text, NodeId chain, SourceRewriter& edits) {
    const SyntaxTree& tree = text.tree();
    std::string closing;
    for (NodeId sum = chain; adds(text, sum); sum = tree.child(sum, 0)) {
        if (const NodeId before = tree.child(sum, 0); adds(text, before)) {
            edits.replace(tree[sum].word, text.word_of(sum) == text.word_of(before) ? "+" : "-");
            closing += ')';
        }
        if (sum != chain)
            edits.wrap(tree.child(sum, 1), "(", "");
    }
    edits.wrap(tree.child(chain, 1), "", closing);
}

} // namespace

Variation vary_sines(const ParsedText& text, const TreeFacts& facts, const MayVary& may) {
    const SyntaxTree& tree = text.tree();
    const std::string prefix = fresh_prefix(text);
    std::string prelude = spell(k_unit, prefix);
    for (const std::string_view name : {"sin", "cos"})
        prelude += spell(k_sine, prefix, name) + vector_overloads(name, prefix);
    return vary(text, may, prefix + "mode", prelude, [&](NodeId id, SourceRewriter& edits) {
        const auto name = tree[id].kind == NodeKind::call ? called_name(text, id) : std::string_view{};
        if ((name != "sin" && name != "cos") || facts.function(name) || must_stay_constant(text, id))
            return false;
        edits.replace(tree[tree.child(id, 0)].word, prefix + std::string(name));
        return true;
    });
}

Variation vary_inputs(const ParsedText& text, const TreeFacts& facts, const MayVary& may) {
    const std::string prefix = fresh_prefix(text);
    const std::string prelude =
        spell(k_unit, prefix) + spell(k_input, prefix) + vector_overloads("input", prefix);
    return vary(text, may, prefix + "mode", prelude, [&](NodeId id, SourceRewriter& edits) {
        const auto name = text.tree()[id].kind == NodeKind::name ? text.word_of(id) : std::string_view{};
        if ((name != "iTime" && name != "iResolution" && name != "iMouse") || must_stay_constant(text, id))
            return false;
        const auto meanings = facts.names.find(name);
        if (meanings == facts.names.end() || !meanings->second.uniform)
            return false;
        edits.wrap(id, prefix + "input(", ")");
        return true;
    });
}

Variation vary_rounding(const ParsedText& text, const TreeFacts& facts, const MayVary& may) {
    return vary_results(text, may, k_lot, [&](NodeId id) {
        if (is_operation(text, facts, id))
            return text.word_of(id).front() == '/';
        const std::string_view name =
            text.tree()[id].kind == NodeKind::call ? called_name(text, id) : std::string_view{};
        const BuiltinFunction* const builtin = facts.function(name) ? nullptr : find_builtin(name);
        return builtin && builtin->is(Trait::inexact);
    });
}

Variation vary_last_bits(const ParsedText& text, const TreeFacts& facts, const MayVary& may) {
    return vary_results(text, may, k_lot, [&](NodeId id) {
        if (is_operation(text, facts, id))
            return true;
        const std::string_view name =
            text.tree()[id].kind == NodeKind::call ? called_name(text, id) : std::string_view{};
        const BuiltinFunction* const builtin = facts.function(name) ? nullptr : find_builtin(name);
        return builtin && (builtin->is(Trait::inexact) || name == "dot" || name == "sin" || name == "cos");
    });
}

Variation vary_halves(const ParsedText& text, const TreeFacts& facts, const MayVary& may) {
    const bool asked = std::ranges::any_of(
        text.words(), [](const Word& word) { return word.text == "mediump" || word.text == "lowp"; });
    if (!asked)
        return {};
    return vary_results(text, may, k_half, [&](NodeId id) { return is_operation(text, facts, id); });
}

bool make_precise(const ParsedText& text, NodeId id, SourceRewriter& edits) {
    const SyntaxTree& tree = text.tree();
    if (tree[id].kind != NodeKind::declaration || tree.around(id, NodeKind::function) == k_no_node)
        return false;
    const NodeId type = tree.child(id, 0);
    if (class_of_type(type_name(text, type)) != TypeClass::floating || has_qualifier(text, type, "const") ||
        has_qualifier(text, type, "precise"))
        return false;
    edits.wrap(type, "precise ", "");
    return true;
}

namespace {

constexpr std::string_view k_precise_header = "#extension GL_ARB_gpu_shader5 : enable\n";

} // namespace

Variation vary_precision(const ParsedText& text, const TreeFacts&, const MayVary& may) {
    return vary(text, may, {}, std::string(k_precise_header),
                [&](NodeId id, SourceRewriter& edits) { return make_precise(text, id, edits); });
}

// Varies sums as other compilers write them: a product added with one rounding, and terms added from the
// other end.

Variation vary_contraction(const ParsedText& text, const TreeFacts& facts, const MayVary& may) {
    const std::string prefix = fresh_prefix(text);
    const std::string prelude = "#extension GL_ARB_gpu_shader_fp64 : enable\n"
                                "#extension GL_ARB_gpu_shader5 : enable\n" +
                                spell(contraction_prelude(text), prefix);
    return vary(text, may, prefix + "mode", prelude, [&](NodeId id, SourceRewriter& edits) {
        return Contraction(text, facts, prefix, edits).contract(id);
    });
}

Variation vary_order(const ParsedText& text, const TreeFacts& facts, const MayVary& may) {
    const SyntaxTree& tree = text.tree();
    return vary(text, may, {}, {}, [&](NodeId id, SourceRewriter& edits) {
        const NodeId parent = tree[id].parent;
        const bool whole_chain = !adds(text, parent) || tree.child(parent, 0) != id;
        if (!adds(text, id) || !whole_chain || !adds(text, tree.child(id, 0)) || facts.surely_whole[id] ||
            must_stay_constant(text, id))
            return false;
        reverse(text, id, edits);
        return true;
    });
}

// Varies the formulas that compilers write for built-in functions.

namespace {

/// Functions of the prelude that are made of a dot product, for vectors of type `@`.
constexpr std::string_view k_made_of_dots =
    R"(float $length(@ v){return ($mode&3)!=0?sqrt($dot(v,v)):length(v);}
float $distance(@ a,@ b){return ($mode&3)!=0?$length(a-b):distance(a,b);}
@ $normalize(@ v){return ($mode&3)!=0?v*inversesqrt($dot(v,v)):normalize(v);}
@ $reflect(@ i,@ n){return ($mode&3)!=0?i-2.0*$dot(n,i)*n:reflect(i,n);}
@ $refract(@ i,@ n,float e){if(($mode&3)==0)return refract(i,n,e);
float d=$dot(n,i),k=1.0-e*e*(1.0-d*d);return k<0.0?@(0.0):e*i-(e*d+sqrt(k))*n;}
)";

/// The same where the order does not matter: numbers, and vectors of two.
constexpr std::string_view k_made_of_short_dots = R"(float $dot(@ a,@ b){return dot(a,b);}
float $length(@ v){return length(v);}
float $distance(@ a,@ b){return distance(a,b);}
@ $normalize(@ v){return normalize(v);}
@ $reflect(@ i,@ n){return reflect(i,n);}
@ $refract(@ i,@ n,float e){return refract(i,n,e);}
)";

std::string formula_prelude(std::string_view prefix) {
    std::string text = "uniform int $mode;\nfloat $pow(float x,float y){return ($mode&4)!=0&&y==0.5?sqrt(x):"
                       "pow(x,y);}\n";
    for (int size = 1; size <= 4; ++size) {
        const std::string_view type = k_float_vectors[size_t(size) - 1];
        std::string first = "a[0]*b[0]", last = fmt::format("a[{0}]*b[{0}]", size - 1), powers;
        for (int i = 1; i < size; ++i) {
            first += fmt::format("+a[{0}]*b[{0}]", i);
            last += fmt::format("+a[{0}]*b[{0}]", size - 1 - i);
        }
        for (int i = 0; i < size; ++i)
            powers += fmt::format("{}$pow(x[{}],y[{}])", i > 0 ? "," : "", i, i);
        if (size > 2)
            text +=
                fmt::format("float $dot({0} a,{0} b){{return ($mode&1)!=0?{1}:($mode&2)!=0?{2}:dot(a,b);}}\n",
                            type, first, last);
        if (size > 1)
            text += fmt::format("{0} $pow({0} x,{0} y){{return {0}({1});}}\n", type, powers);
        text += spell(size > 2 ? k_made_of_dots : k_made_of_short_dots, prefix, type);
    }
    for (int columns = 2; columns <= 4; ++columns)
        for (int rows = 2; rows <= 4; ++rows) {
            std::string parts;
            for (int column = 0; column < columns; ++column)
                parts += fmt::format("{}$dot(v,m[{}])", column > 0 ? "," : "", column);
            text +=
                fmt::format("vec{0} $times(vec{1} v,mat{0}x{1} m){{return ($mode&3)!=0?vec{0}({2}):v*m;}}\n",
                            columns, rows, parts);
        }
    return spell(text, prefix);
}

/// Returns the prelude's function for a call or a product; empty: the node is none of them.
std::string_view formula_of(const ParsedText& text, const TreeFacts& facts, NodeId id) {
    constexpr std::string_view k_functions[] = {"dot",     "length",  "distance", "normalize",
                                                "reflect", "refract", "pow"};
    const SyntaxTree& tree = text.tree();
    if (tree[id].kind == NodeKind::call) {
        const std::string_view name = called_name(text, id);
        return std::ranges::count(k_functions, name) > 0 && !facts.function(name) ? name : std::string_view{};
    }
    const std::string_view word = text.word_of(id);
    if (!(tree[id].kind == NodeKind::binary && word == "*") &&
        !(tree[id].kind == NodeKind::assign && word == "*="))
        return {};
    const auto left = expression_type(text, facts, tree.child(id, 0));
    const auto right = expression_type(text, facts, tree.child(id, 1));
    const bool is_row = left && right && right->matrix() && !left->matrix() && !left->scalar();
    return is_row && left->base == 'f' && right->base == 'f' ? "times" : std::string_view{};
}

Variation vary_formulas_in(const ParsedText& text, const TreeFacts& facts, const MayVary& may, bool precise) {
    const SyntaxTree& tree = text.tree();
    const std::string prefix = fresh_prefix(text);
    const std::string header(precise ? k_precise_header : "");
    return vary(text, may, prefix + "mode", header + formula_prelude(prefix),
                [&](NodeId id, SourceRewriter& edits) {
                    if (precise && make_precise(text, id, edits))
                        return true;
                    const std::string_view name = formula_of(text, facts, id);
                    if (name.empty() || must_stay_constant(text, id))
                        return false;
                    const std::string function = prefix + std::string(name);
                    if (tree[id].kind == NodeKind::call) {
                        edits.replace(tree[tree.child(id, 0)].word, function);
                        return true;
                    }
                    edits.wrap(id, function + "(", ")");
                    if (tree[id].kind == NodeKind::assign)
                        edits.wrap(id, "(" + words_of(text, tree.child(id, 0)) + "=", ")");
                    edits.replace(tree[id].word, ",");
                    return true;
                });
}

} // namespace

Variation vary_formulas(const ParsedText& text, const TreeFacts& facts, const MayVary& may) {
    return vary_formulas_in(text, facts, may, false);
}

Variation vary_precise_formulas(const ParsedText& text, const TreeFacts& facts, const MayVary& may) {
    return vary_formulas_in(text, facts, may, true);
}

// Varies what a device measures between neighbouring pixels.

Variation vary_mipmaps(const ParsedText& text, const TreeFacts& facts, const MayVary& may) {
    const SyntaxTree& tree = text.tree();
    const std::string prefix = fresh_prefix(text);
    const std::string prelude =
        spell("uniform int $mode;\nfloat $bias(){return $mode==1?0.5:$mode==2?-0.5:0.0;}\n", prefix);
    return vary(text, may, prefix + "mode", prelude, [&](NodeId id, SourceRewriter& edits) {
        const auto name = tree[id].kind == NodeKind::call ? called_name(text, id) : std::string_view{};
        if ((name != "texture" && name != "texture2D" && name != "textureCube") || facts.function(name) ||
            tree.child_count(id) != 3)
            return false;
        edits.wrap(tree.child(id, 2), "", fmt::format(",{}bias()", prefix));
        return true;
    });
}

Variation vary_derivatives(const ParsedText& text, const TreeFacts& facts, const MayVary& may) {
    const SyntaxTree& tree = text.tree();
    const std::string prefix = fresh_prefix(text);
    std::string prelude =
        "#extension GL_ARB_derivative_control : enable\n" + spell("uniform int $mode;\n", prefix);
    for (const std::string_view name : {"dFdx", "dFdy", "fwidth"})
        for (const std::string_view type : k_float_vectors)
            prelude += spell(
                fmt::format("{0} $@({0} v){{return $mode==1?@Fine(v):$mode==2?@Coarse(v):@(v);}}\n", type),
                prefix, name);
    return vary(text, may, prefix + "mode", prelude, [&](NodeId id, SourceRewriter& edits) {
        const auto name = tree[id].kind == NodeKind::call ? called_name(text, id) : std::string_view{};
        if ((name != "dFdx" && name != "dFdy" && name != "fwidth") || facts.function(name))
            return false;
        edits.replace(tree[tree.child(id, 0)].word, prefix + std::string(name));
        return true;
    });
}

VariedArithmetic varied_sines() {
    return {vary_sines,
            {{int(SineMode::unit_up), "sines a unit in the last place larger"},
             {int(SineMode::unit_down), "sines a unit smaller"},
             {int(SineMode::like_nvidia), "a sine like NVIDIA's"}}};
}

VariedArithmetic varied_inputs() {
    return {vary_inputs, {{1, "iTime, iResolution and iMouse a unit in the last place larger", false}}};
}

std::vector<VariedArithmetic> varied_sums() {
    return {{vary_precision, {{0, "everything `precise`", false}}},
            {vary_contraction, {{1, "fused multiply-add"}}},
            {vary_order, {{0, "sums added in reverse order", false}}}};
}

std::vector<VariedArithmetic> varied_operations() {
    std::vector<VariedArithmetic> all = varied_sums();
    all.push_back({vary_rounding, {{1, "quotients, roots, powers and logarithms a unit off"}}});
    return all;
}

std::vector<VariedArithmetic> varied_formulas() {
    constexpr int k_first = int(FormulaPart::first_component), k_last = int(FormulaPart::last_component),
                  k_root = int(FormulaPart::root);
    std::vector<VariationMode> modes{
        {k_first, "dot products summed from the first component on"},
        {k_last, "dot products summed from the last component on"},
        {k_root, "pow(x, 0.5) as a root"},
        {k_first | k_root, "dot products summed from the first component on, and pow(x, 0.5) as a root"},
        {k_last | k_root, "dot products summed from the last component on, and pow(x, 0.5) as a root"}};
    return {
        {vary_formulas, modes},
        {vary_precise_formulas,
         {{k_first | k_root, "everything `precise`, with dot products summed from the first component on"},
          {k_last | k_root, "everything `precise`, with dot products summed from the last component on"}}}};
}

std::vector<VariedArithmetic> varied_roundings() {
    std::vector<VariedArithmetic> all = varied_operations();
    all.insert(all.begin(), varied_inputs());
    return all;
}

} // namespace tidemark::glsl
