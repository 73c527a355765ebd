#include "glsl/watch/domains.hpp"

#include "glsl/watch/respelling.hpp"
#include "glsl/watch/watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

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
/// Of the operator. Of x / 0 chapter 4.7.1 tells what it is, of 0 / 0 it does not.
constexpr std::string_view k_quotient = "quotient";
constexpr std::string_view k_quotient_fault = "of 0 and 0";

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

/// One branch for a vector, for there are many quotients, many of them in loops.
std::string float_quotients(std::string_view prefix) {
    std::string text = fmt::format("float {0}quotient(float x,float y,int i){{float r=x/y;"
                                   "if(abs(x)+abs(y)==0.0)r={0}undefined(i,0.0,r);return r;}}\n",
                                   prefix);
    for (const std::string_view vector : {"vec2", "vec3", "vec4"})
        for (const auto& [left, right] : {std::pair(vector, vector), {vector, "float"}, {"float", vector}})
            text += fmt::format("{1} {0}quotient({2} x,{3} y,int i){{{1} r=x/y;"
                                "b{1} none=equal({1}(abs(x)+abs(y)),{1}(0.0));if(any(none)){{"
                                "float other={0}undefined(i,0.0,0.0);"
                                "if({0}number>=0)r=mix(r,{1}(other),none);}}return r;}}\n",
                                prefix, vector, left, right);
    return text;
}

/// Those that are not watched: of whole numbers, and those with matrices.
std::string other_quotients(std::string_view prefix) {
    std::string text;
    const auto add = [&](const std::string& left, const std::string& right, const std::string& result) {
        text +=
            fmt::format("{0} {1}quotient({2} x,{3} y,int i){{return x/y;}}\n", result, prefix, left, right);
    };
    for (const std::string number : {"int", "uint"}) {
        add(number, number, number);
        for (int size = 2; size <= 4; ++size) {
            const std::string vector = fmt::format("{}vec{}", number[0], size);
            add(vector, vector, vector);
            add(vector, number, vector);
            add(number, vector, vector);
        }
    }
    for (int columns = 2; columns <= 4; ++columns)
        for (int rows = 2; rows <= 4; ++rows) {
            const std::string matrix = fmt::format("mat{}x{}", columns, rows);
            add(matrix, matrix, matrix);
            add(matrix, "float", matrix);
            add("float", matrix, matrix);
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

/// `iResolution.xy`: the host draws nothing without a size.
bool is_the_size(const ParsedText& text, NodeId id) {
    const SyntaxTree& tree = text.tree();
    while (tree[id].kind == NodeKind::member || tree[id].kind == NodeKind::parenthesis)
        id = tree.child(id, 0);
    return tree[id].kind == NodeKind::name && text.word_of(id) == "iResolution";
}

/// `max(x, 0.01)`.
bool is_guarded(const ParsedText& text, NodeId id) {
    const SyntaxTree& tree = text.tree();
    if (tree[id].kind != NodeKind::call || called_name(text, id) != "max")
        return false;
    const auto is_positive = [&](NodeId part) {
        const auto numbers = numbers_of(text, part);
        return numbers && std::ranges::all_of(*numbers, [](double v) { return v > 0; });
    };
    return is_positive(tree.child(id, 1)) || is_positive(tree.child(id, 2));
}

/// Whether the text itself says that the call is inside of its domain.
bool surely_defined(const ParsedText& text, NodeId call, std::string_view name) {
    const SyntaxTree& tree = text.tree();
    const size_t before = tree[call].kind == NodeKind::call; // its name is a child
    const NodeId first = tree.child(call, before);
    const NodeId second = tree.child(call, before + 1);
    const auto all = [&](NodeId id, auto&& holds) {
        const auto numbers = id == k_no_node ? std::nullopt : numbers_of(text, id);
        return numbers && std::ranges::all_of(*numbers, holds);
    };
    const auto not_zero = [](double v) { return v != 0; };
    if (name == "smoothstep") {
        const auto low = number_of(text, first);
        return low && all(second, [&](double edge) { return edge != *low; });
    }
    if (name == "mod")
        return all(second, not_zero);
    if (name == k_quotient && (is_the_size(text, second) || is_guarded(text, second)))
        return true;
    if (name == k_quotient || name == "atan")
        return all(first, not_zero) || all(second, not_zero);
    if (name == "normalize")
        return all(first, not_zero);
    if (name == "asin" || name == "acos" || name == "atanh" || name == "acosh")
        return false;
    return all(first, [](double v) { return v > 0; });
}

/// Leads the call or the quotient through ours, as number `number`.
void lead(const ParsedText& text, NodeId id, std::string_view prefix, size_t number, Respelling& edits) {
    const SyntaxTree& tree = text.tree();
    const std::string function = fmt::format("{}{}", prefix, domain_name(text, id));
    const std::string last = fmt::format(",{})", number);
    switch (tree[id].kind) {
    case NodeKind::call:
        edits.replace(tree[tree.child(id, 0)].word, function);
        edits.replace(tree[id].end - 1, last);
        return;
    case NodeKind::binary:
        edits.replace(tree[id].word, ",");
        edits.wrap(id, function + "(", last);
        return;
    default: // x /= y
        edits.replace(tree[id].word, fmt::format("={}({},", function, words_of(text, tree.child(id, 0))));
        edits.wrap(tree.child(id, 1), "(", ")" + last);
    }
}

/// Whether `id` has a domain, as GLSL's own functions and the quotient have.
bool is_watched(const ParsedText& text, const TreeFacts& facts, NodeId id) {
    const std::string_view name = domain_name(text, id);
    if (text.tree()[id].kind != NodeKind::call)
        return name == k_quotient && is_watched_operation(text, facts, id);
    return (name == k_normalize || domain_of(name)) && !facts.function(name) &&
           (name != "atan" || text.tree().child_count(id) == 3);
}

} // namespace

std::string_view domain_name(const ParsedText& text, NodeId id) {
    switch (text.tree()[id].kind) {
    case NodeKind::call: return called_name(text, id);
    case NodeKind::binary:
    case NodeKind::assign: return text.word_of(id).starts_with('/') ? k_quotient : std::string_view{};
    default: return {};
    }
}

DomainWatch watch_domains(const ParsedText& text, const TreeFacts& facts, int width) {
    const SyntaxTree& tree = text.tree();
    const std::string prefix = fresh_prefix(text);
    DomainWatch result{{}, {}, prefix + "number", prefix + "value"};
    Respelling edits(text);
    std::vector<std::string_view> used;
    for (NodeId id = 1; id < tree.nodes.size(); ++id) {
        const std::string_view name = domain_name(text, id);
        if (!is_watched(text, facts, id) || must_stay_constant(text, id) || surely_defined(text, id, name))
            continue;
        lead(text, id, prefix, result.calls.size(), edits);
        result.calls.push_back(id);
        used.push_back(name);
    }
    std::string prelude = spell(k_prelude, prefix);
    prelude.replace(prelude.find('%'), 1, std::to_string(width));
    for (const Domain& domain : k_domains)
        if (std::ranges::find(used, domain.name) != used.end())
            prelude += overloads(domain, prefix);
    if (std::ranges::find(used, k_quotient) != used.end())
        prelude += float_quotients(prefix) + other_quotients(prefix);
    if (std::ranges::find(used, k_normalize) != used.end())
        for (const std::string_view type : {"float", "vec2", "vec3", "vec4"})
            prelude += spell(k_normalize_overload, prefix, type);
    result.text = headers_with_buffers(text) + prelude + edits.text();
    return result;
}

std::string_view domain_fault(std::string_view name) {
    if (const Domain* domain = domain_of(name))
        return domain->fault;
    return name == k_quotient ? k_quotient_fault : k_normalize_fault;
}

} // namespace tidemark::glsl
