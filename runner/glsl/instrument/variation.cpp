#include "glsl/instrument/variation.hpp"

#include "glsl/analysis/float_operation.hpp"
#include "glsl/instrument/source_rewriter.hpp"
#include "glsl/instrument/watch.hpp"
#include "glsl/syntax/builtin_functions.hpp"

#include <fmt/format.h>

#include <algorithm>

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

/// Returns the text with the changes of `change(node, edits)`, children first; `change` returns whether it
/// changed anything.
template <class Change>
Variation vary(const ParsedText& text, const std::string& mode, const std::string& prelude, Change change) {
    Variation result{{}, mode};
    SourceRewriter edits(text);
    for (NodeId id = 1; id < text.tree().nodes.size(); ++id)
        result.places += change(id, edits) ? 1 : 0;
    result.text = headers_with_buffers(text) + prelude + edits.text();
    return result;
}

/// Passes the result of each operation, assignment or call that `is_meant` accepts through `$off`.
template <class IsMeant>
Variation vary_results(const ParsedText& text, std::string_view off, IsMeant is_meant) {
    const SyntaxTree& tree = text.tree();
    const std::string prefix = fresh_prefix(text);
    const std::string prelude = spell("uniform int $mode;\n", prefix) + spell(off, prefix) +
                                vector_overloads("off", prefix) + other_overloads("off", prefix);
    return vary(text, prefix + "mode", prelude, [&](NodeId id, SourceRewriter& edits) {
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

} // namespace

Variation vary_sines(const ParsedText& text, const TreeFacts& facts) {
    const SyntaxTree& tree = text.tree();
    const std::string prefix = fresh_prefix(text);
    std::string prelude = spell(k_unit, prefix);
    for (const std::string_view name : {"sin", "cos"})
        prelude += spell(k_sine, prefix, name) + vector_overloads(name, prefix);
    return vary(text, prefix + "mode", prelude, [&](NodeId id, SourceRewriter& edits) {
        const auto name = tree[id].kind == NodeKind::call ? called_name(text, id) : std::string_view{};
        if ((name != "sin" && name != "cos") || facts.function(name) || must_stay_constant(text, id))
            return false;
        edits.replace(tree[tree.child(id, 0)].word, prefix + std::string(name));
        return true;
    });
}

Variation vary_inputs(const ParsedText& text, const TreeFacts& facts) {
    const std::string prefix = fresh_prefix(text);
    const std::string prelude =
        spell(k_unit, prefix) + spell(k_input, prefix) + vector_overloads("input", prefix);
    return vary(text, prefix + "mode", prelude, [&](NodeId id, SourceRewriter& edits) {
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

Variation vary_rounding(const ParsedText& text, const TreeFacts& facts) {
    return vary_results(text, k_lot, [&](NodeId id) {
        if (is_operation(text, facts, id))
            return text.word_of(id).front() == '/';
        const std::string_view name =
            text.tree()[id].kind == NodeKind::call ? called_name(text, id) : std::string_view{};
        const BuiltinFunction* const builtin = facts.function(name) ? nullptr : find_builtin(name);
        return builtin && builtin->is(Trait::inexact);
    });
}

Variation vary_halves(const ParsedText& text, const TreeFacts& facts) {
    const bool asked = std::ranges::any_of(
        text.words(), [](const Word& word) { return word.text == "mediump" || word.text == "lowp"; });
    if (!asked)
        return {};
    return vary_results(text, k_half, [&](NodeId id) { return is_operation(text, facts, id); });
}

Variation vary_precision(const ParsedText& text, const TreeFacts&) {
    const SyntaxTree& tree = text.tree();
    const std::string header = "#extension GL_ARB_gpu_shader5 : enable\n";
    return vary(text, {}, header, [&](NodeId id, SourceRewriter& edits) {
        if (tree[id].kind != NodeKind::declaration || tree.around(id, NodeKind::function) == k_no_node)
            return false;
        const NodeId type = tree.child(id, 0);
        if (class_of_type(type_name(text, type)) != TypeClass::floating ||
            has_qualifier(text, type, "const") || has_qualifier(text, type, "precise"))
            return false;
        edits.wrap(type, "precise ", "");
        return true;
    });
}

} // namespace tidemark::glsl
