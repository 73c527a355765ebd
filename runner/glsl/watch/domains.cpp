#include "glsl/watch/domains.hpp"

#include "glsl/watch/respelling.hpp"
#include "glsl/watch/watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

namespace tidemark::glsl {
namespace {

/// One number at a time; the sentences are those of GLSL 4.50, chapter 8.
struct Domain {
    std::string_view name;
    std::string_view arguments; ///< of its overload for floats
    std::string_view undefined;
    std::string_view told; ///< the argument that is written down
    std::string_view fault;
};
constexpr Domain k_domains[] = {
    {"pow", "float x,float y", "x<0.0||(x==0.0&&y<=0.0)", "x", "of a negative number"},
    {"sqrt", "float x", "x<0.0", "x", "of a negative number"},
    {"inversesqrt", "float x", "x<=0.0", "x", "of a number that is not above 0"},
    {"log", "float x", "x<=0.0", "x", "of a number that is not above 0"},
    {"log2", "float x", "x<=0.0", "x", "of a number that is not above 0"},
    {"asin", "float x", "abs(x)>1.0", "x", "of a number beyond 1"},
    {"acos", "float x", "abs(x)>1.0", "x", "of a number beyond 1"},
    {"acosh", "float x", "x<1.0", "x", "of a number below 1"},
    {"atanh", "float x", "abs(x)>=1.0", "x", "of a number that is not below 1"},
    {"atan", "float x,float y", "x==0.0&&y==0.0", "x", "of 0 and 0"},
    {"mod", "float x,float y", "y==0.0", "y", "by 0"},
    {"smoothstep", "float x,float y,float z", "x==y", "x", "with equal edges"},
};
constexpr std::string_view k_normalize = "normalize";
constexpr std::string_view k_normalize_fault = "of a vector without length";

/// Overloads that mix a float with vectors: bit i is set where argument i is a vector.
std::vector<unsigned> shapes(const Domain& domain) {
    if (domain.name == "mod")
        return {0b11, 0b01};
    if (domain.name == "smoothstep")
        return {0b111, 0b100};
    return {domain.arguments.size() > 8 ? 0b11u : 0b1u};
}

constexpr std::string_view k_prelude =
    R"(layout(std430,binding=0) buffer $Buffer{uint $out[];};
uniform int $number;
uniform float $value;
float $undefined(int i,float told,float plain){
atomicAdd($out[3*i],1u);
atomicMax($out[3*i+1],~uint(int(gl_FragCoord.x)+%*int(gl_FragCoord.y)));
uint bits=floatBitsToUint(told);
atomicMax($out[3*i+2],bits<<1|bits>>31);
return $number==i?$value:$number<0?plain:0.0;}
)";

constexpr std::string_view k_normalize_overload =
    "@ $normalize(@ x,int i){@ r=normalize(x);if(dot(x,x)==0.0)r=@($undefined(i,0.0,0.0));return r;}\n";

std::string overloads(const Domain& domain, std::string_view prefix) {
    constexpr std::string_view k_names = "xyz";
    const size_t count = 1 + size_t(std::ranges::count(domain.arguments, ','));
    std::string passed;
    for (size_t i = 0; i < count; ++i)
        passed += fmt::format("{}{}", i > 0 ? "," : "", k_names[i]);
    std::string text =
        fmt::format("float {0}{1}({2},int i){{float r={1}({3});if({4})r={0}undefined(i,{5},r);"
                    "return r;}}\n",
                    prefix, domain.name, domain.arguments, passed, domain.undefined, domain.told);
    for (const unsigned shape : shapes(domain))
        for (size_t size = 2; size <= 4; ++size) {
            std::string declared, parts;
            for (size_t i = 0; i < count; ++i)
                declared += (shape >> i & 1u) != 0 ? fmt::format("vec{} {},", size, k_names[i])
                                                   : fmt::format("float {},", k_names[i]);
            for (size_t part = 0; part < size; ++part) {
                parts += fmt::format("{}{}{}(", part > 0 ? "," : "", prefix, domain.name);
                for (size_t i = 0; i < count; ++i)
                    parts += (shape >> i & 1u) != 0 ? fmt::format("{}[{}],", k_names[i], part)
                                                    : fmt::format("{},", k_names[i]);
                parts += "i)";
            }
            text += fmt::format("vec{0} {1}{2}({3}int i){{return vec{0}({4});}}\n", size, prefix, domain.name,
                                declared, parts);
        }
    return text;
}

const Domain* domain_of(std::string_view name) {
    const auto* found = std::ranges::find(k_domains, name, &Domain::name);
    return found == std::end(k_domains) ? nullptr : found;
}

/// A number that stands in the text.
std::optional<double> number_of(const ParsedText& text, NodeId id) {
    const SyntaxTree& tree = text.tree();
    if (tree[id].kind == NodeKind::parenthesis)
        return number_of(text, tree.child(id, 0));
    if (tree[id].kind == NodeKind::prefix && text.word_of(id) == "-") {
        const auto inside = number_of(text, tree.child(id, 0));
        return inside ? std::optional(-*inside) : std::nullopt;
    }
    if (tree[id].kind != NodeKind::literal)
        return std::nullopt;
    double value = 0;
    const std::string_view digits = text.word_of(id);
    if (std::from_chars(digits.data(), digits.data() + digits.size(), value).ec != std::errc{})
        return std::nullopt;
    return value;
}

/// Every number of `2.0`, `vec3(1.0, 2.0, 3.0)`; nothing for what does not stand in the text.
std::optional<std::vector<double>> numbers_of(const ParsedText& text, NodeId id) {
    if (const auto one = number_of(text, id))
        return std::vector<double>{*one};
    const SyntaxTree& tree = text.tree();
    if (tree[id].kind != NodeKind::call || class_of_type(called_name(text, id)) != TypeClass::floating)
        return std::nullopt;
    std::vector<double> all;
    for (NodeId part = tree[tree.child(id, 0)].next; part != k_no_node; part = tree[part].next) {
        const auto one = number_of(text, part);
        if (!one)
            return std::nullopt;
        all.push_back(*one);
    }
    return all;
}

/// Whether the text itself says that the call is inside of its domain.
bool surely_defined(const ParsedText& text, NodeId call, std::string_view name) {
    const SyntaxTree& tree = text.tree();
    const NodeId first = tree.child(call, 1);
    const NodeId second = tree.child(call, 2);
    const auto all = [&](NodeId id, auto&& holds) {
        const auto numbers = id == k_no_node ? std::nullopt : numbers_of(text, id);
        return numbers && std::ranges::all_of(*numbers, holds);
    };
    if (name == "smoothstep") {
        const auto low = number_of(text, first);
        return low && all(second, [&](double edge) { return edge != *low; });
    }
    if (name == "mod")
        return all(second, [](double v) { return v != 0; });
    if (name == "atan")
        return all(first, [](double v) { return v != 0; }) || all(second, [](double v) { return v != 0; });
    if (name == "normalize")
        return all(first, [](double v) { return v != 0; });
    if (name == "asin" || name == "acos" || name == "atanh" || name == "acosh")
        return false;
    return all(first, [](double v) { return v > 0; });
}

} // namespace

DomainWatch watch_domains(const ParsedText& text, const TreeFacts& facts, int width) {
    const SyntaxTree& tree = text.tree();
    const std::string prefix = fresh_prefix(text);
    DomainWatch result{{}, {}, prefix + "number", prefix + "value"};
    Respelling edits(text);
    std::vector<std::string_view> used;
    for (NodeId id = 1; id < tree.nodes.size(); ++id) {
        if (tree[id].kind != NodeKind::call)
            continue;
        const std::string_view name = called_name(text, id);
        const bool known = name == k_normalize || domain_of(name);
        if (!known || facts.function(name) || must_stay_constant(text, id) ||
            surely_defined(text, id, name) || (name == "atan" && tree.child_count(id) != 3))
            continue;
        edits.replace(tree[tree.child(id, 0)].word, prefix + std::string(name));
        edits.replace(tree[id].end - 1, fmt::format(",{})", result.calls.size()));
        result.calls.push_back(id);
        used.push_back(name);
    }
    std::string prelude = spell(k_prelude, prefix);
    prelude.replace(prelude.find('%'), 1, std::to_string(width));
    for (const Domain& domain : k_domains)
        if (std::ranges::find(used, domain.name) != used.end())
            prelude += overloads(domain, prefix);
    if (std::ranges::find(used, k_normalize) != used.end())
        for (const std::string_view type : {"float", "vec2", "vec3", "vec4"})
            prelude += spell(k_normalize_overload, prefix, type);
    result.text = headers_with_buffers(text) + prelude + edits.text();
    return result;
}

std::string_view domain_fault(std::string_view name) {
    const Domain* domain = domain_of(name);
    return domain ? domain->fault : k_normalize_fault;
}

} // namespace tidemark::glsl
