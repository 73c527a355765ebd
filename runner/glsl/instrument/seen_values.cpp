#include "glsl/instrument/seen_values.hpp"

#include "glsl/instrument/source_rewriter.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::glsl {
namespace {

/// GLSL before the text; `@` is the number of expressions.
constexpr std::string_view k_seen_prelude = R"(uniform int $which;
vec4 $seen[@];
bool $met[@];
float $see(int i,float v){$seen[i]=vec4(v,0.0,0.0,0.0);$met[i]=true;return v;}
vec2 $see(int i,vec2 v){$seen[i]=vec4(v,0.0,0.0);$met[i]=true;return v;}
vec3 $see(int i,vec3 v){$seen[i]=vec4(v,0.0);$met[i]=true;return v;}
vec4 $see(int i,vec4 v){$seen[i]=v;$met[i]=true;return v;}
)";

/// GLSL at the end of `main`; `@` is its output.
constexpr std::string_view k_show = "@=$met[$which]?$seen[$which]:vec4(uintBitsToFloat(0x7fc00000u));}\n";

/// GLSL at the start of `main`; `@` is the number of expressions. Globals have no initial values.
constexpr std::string_view k_begin = "for(int $i=0;$i<@;++$i)$met[$i]=false;\n";

NodeId body_of_main(const ParsedText& text) {
    const SyntaxTree& tree = text.tree();
    for (const NodeId function : tree.children(0))
        if (tree[function].kind == NodeKind::function && text.word_of(function) == "main")
            for (const NodeId part : tree.children(function))
                if (tree[part].kind == NodeKind::block)
                    return part;
    return k_no_node;
}

} // namespace

SeenValues see_values(const ParsedText& text, std::span<const NodeId> expressions, std::string_view output) {
    const bool ours =
        std::ranges::any_of(text.words(), [&](const Word& word) { return word.text == output; });
    const NodeId body = body_of_main(text);
    if (!ours || body == k_no_node || expressions.empty())
        return {};
    const std::string prefix = fresh_prefix(text), count = fmt::format("{}", expressions.size());
    SourceRewriter edits(text);
    std::vector<size_t> order(expressions.size());
    for (size_t i = 0; i < order.size(); ++i)
        order[i] = i;
    std::ranges::sort(order, {}, [&](size_t i) { return expressions[i]; }); // inner nodes first
    for (const size_t i : order)
        edits.wrap(expressions[i], fmt::format("{}see({},", prefix, i), ")");
    const Node& main = text.tree()[body];
    edits.replace(main.begin, "{" + spell(k_begin, prefix, count));
    edits.replace(main.end - 1, spell(k_show, prefix, output));
    return {headers_with_buffers(text) + spell(k_seen_prelude, prefix, count) + edits.text(),
            prefix + "which"};
}

} // namespace tidemark::glsl
