// Writes the GLSL functions that a text with watched domains calls: one overload per type.

#include "shader/domain_watch.hpp"

#include "shader/builtin_functions.hpp"
#include "shader/source_edits.hpp"
#include "shader/undefined_behaviour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace tidemark::glsl {

struct DomainPreludeOptions {
    std::string prefix;         ///< prefix of every name
    size_t objectives = 0;      ///< number of objectives
    size_t first_objective = 0; ///< buffer index of the first objective
};

namespace {

constexpr std::string_view k_basis = R"(layout(std430,binding=0) buffer $Buffer{uint $out[];};
uniform int $number;
uniform float $value;
uniform int $stride;
uniform int $left;
uniform int $down;
uniform int $count;
uniform int $width;
float $none;
vec4 $place(){return vec4((gl_FragCoord.xy-0.5)*float($stride)+vec2($left,$down)+0.5,gl_FragCoord.zw);}
void $note(int i,uint argument,uint limit){
atomicAdd($out[4*i],1u);
atomicMax($out[4*i+1],~uint(int(gl_FragCoord.x)+$width*int(gl_FragCoord.y)));
atomicMax($out[4*i+2],argument);
atomicMax($out[4*i+3],limit);
}
float $undefined(int i,float argument,float plain){
uint bits=floatBitsToUint(argument);
$note(i,bits<<1|bits>>31,0u);
return $number==i?$value:$number<0?plain:0.0;}
void $whole(int i,int argument,uint limit){$note(i,uint(argument)<<1|uint(argument)>>31,limit);}
void $near(inout float m,float room){m=room<m?room:m;}
)";

/// Encodes a float's bits so that less room is a larger number; 0: nothing recorded.
constexpr std::string_view k_objectives = R"(float $m[@];
void $begin(){for(int i=0;i<$count;++i)$m[i]=3e38;}
void $flush(){for(int i=0;i<$count;++i)if($m[i]<3e38){
uint bits=floatBitsToUint($m[i]);
uint key=bits>>31!=0u?bits:~bits&0x7fffffffu;
uint placed=(key&0xfffff000u)|uint(int(gl_FragCoord.x)+$width*int(gl_FragCoord.y));
if(key>$out[#+2*i])atomicMax($out[#+2*i],key);
if(placed>$out[#+2*i+1])atomicMax($out[#+2*i+1],placed);
}}
)";

/// Returns the overloads of normalize, whose domain concerns the whole vector.
std::string normalize_overloads(std::string_view prefix) {
    std::string text;
    for (const std::string_view type : k_float_vectors)
        text += spell("@ $normalize(@ x,int i,inout float m){@ r=normalize(x);$near(m,dot(x,x));"
                      "if(dot(x,x)==0.0)r=@($undefined(i,0.0,0.0));return r;}\n",
                      prefix, type);
    return text;
}

/// Returns an overload for floats, which tests the domain, and overloads for vectors, which call it per
/// component.
std::string overloads(const BuiltinFunction& function, std::string_view prefix) {
    constexpr std::string_view k_names = "xyz";
    const Domain& domain = *function.domain;
    const size_t count = most_parameters(function);
    const auto for_each = [&](auto&& spelled) {
        std::string text;
        for (size_t i = 0; i < count; ++i)
            text += fmt::format("{}{}", i > 0 ? "," : "", spelled(i));
        return text;
    };
    std::string undefined(domain.undefined[0].glsl);
    if (domain.undefined[1].holds)
        undefined += fmt::format("||{}", domain.undefined[1].glsl);
    std::string text = fmt::format(
        "float {0}{1}({2},int i,inout float m){{float r={1}({3});{0}near(m,{6});"
        "if({4})r={0}undefined(i,{5},r);return r;}}\n",
        prefix, function.name, for_each([&](size_t i) { return fmt::format("float {}", k_names[i]); }),
        for_each([&](size_t i) { return k_names[i]; }), undefined, domain.argument, domain.room);
    std::set<std::string> seen;
    for (const BuiltinOverload& overload : overloads_of(function)) {
        const auto type = [&](size_t i) { return overload.parameters[i].type; };
        if (overload.parameters.size() != count || overload.result == "float")
            continue;
        const std::string parameters =
            for_each([&](size_t i) { return fmt::format("{} {}", type(i), k_names[i]); });
        if (!seen.insert(parameters).second)
            continue; // `I I I I` and `I I i i` are one for scalars
        const bool watched = class_of_type(overload.result) == TypeClass::floating;
        std::string parts;
        for (int part = 0; watched && part < value_type(overload.result)->rows; ++part)
            parts += fmt::format("{}{}{}({},i,m)", part > 0 ? "," : "", prefix, function.name,
                                 for_each([&](size_t i) {
                                     return type(i) == "float" ? fmt::format("{}", k_names[i])
                                                               : fmt::format("{}[{}]", k_names[i], part);
                                 }));
        if (!watched) // clamp of whole numbers
            parts = fmt::format("{}({})", function.name, for_each([&](size_t i) { return k_names[i]; }));
        text += fmt::format("{0} {1}{2}({3},int i,inout float m){{return {0}({4});}}\n", overload.result,
                            prefix, function.name, parameters, parts);
    }
    return text;
}

/// Returns the quotients of floats, with one branch per vector: quotients are many, and often in loops.
std::string float_quotients(std::string_view prefix) {
    std::string text =
        fmt::format("float {0}quotient(float x,float y,int i,inout float m){{float r=x/y;{0}near(m,abs(y));"
                    "if(abs(x)+abs(y)==0.0)r={0}undefined(i,0.0,r);return r;}}\n",
                    prefix);
    for (const std::string_view vector : {"vec2", "vec3", "vec4"})
        for (const auto& [left, right] : {std::pair(vector, vector), {vector, "float"}, {"float", vector}}) {
            std::string least = "abs(y)";
            if (right != "float") {
                least = "abs(y.x)";
                for (const char part : std::string_view("yzw").substr(0, size_t(right.back() - '1')))
                    least = fmt::format("min({},abs(y.{}))", least, part);
            }
            text += fmt::format("{1} {0}quotient({2} x,{3} y,int i,inout float m){{{1} r=x/y;{0}near(m,{4});"
                                "b{1} none=equal({1}(abs(x)+abs(y)),{1}(0.0));if(any(none)){{"
                                "float other={0}undefined(i,0.0,0.0);"
                                "if({0}number>=0)r=mix(r,{1}(other),none);}}return r;}}\n",
                                prefix, vector, left, right, least);
        }
    return text;
}

/// Returns `$whole(x, y)` and `$mod(x, y)`: as `x / y` and `mod(x, y)`, but note a whole quotient that a
/// division by the reciprocal misses. Only the site that `$number` names returns what that division gives.
std::string rounded_quotients(std::string_view prefix, bool precise) {
    const std::string_view k_precise = precise ? "precise " : "";
    std::string text;
    for (const auto& [name, plain, other] :
         {std::array<std::string_view, 3>{"rounded", "x/y", "q"}, {"mod", "mod(x,y)", "x-y*floor(q)"}})
        text += fmt::format(
            "float {0}{1}(float x,float y,int i,inout float m){{float r={2};{0}near(m,abs(y));"
            "if({3})return {0}undefined(i,0.0,r);"
            "{4}float k=1.0/y;{4}float q=x*k;float w=x/y;"
            "if(w==floor(w)&&floor(q)!=w&&abs(w)<1e6){{uint b=floatBitsToUint(w);"
            "{0}note(i,b<<1|b>>31,0u);if({0}number==i)r={5};}}return r;}}\n",
            prefix, name, plain, name == "mod" ? "y==0.0" : "abs(x)+abs(y)==0.0", k_precise, other);
    for (const std::string_view vector : {"vec2", "vec3", "vec4"})
        for (const auto& [left, right] : {std::pair(vector, vector), {vector, "float"}, {"float", vector}})
            for (const std::string_view name : {"rounded", "mod"}) {
                if (name == "mod" && left == "float")
                    continue;
                std::string parts;
                for (const char part : std::string_view("xyzw").substr(0, size_t(vector.back() - '0')))
                    parts += fmt::format("{}{}{}(x{},y{},i,m)", parts.empty() ? "" : ",", prefix, name,
                                         left == "float" ? "" : fmt::format(".{}", part),
                                         right == "float" ? "" : fmt::format(".{}", part));
                text += fmt::format("{0} {1}{2}({3} x,{4} y,int i,inout float m){{return {0}({5});}}\n",
                                    vector, prefix, name, left, right, parts);
            }
    return text;
}

/// Joins `make(type, components)` for the types of whole numbers.
template <class Make>
std::string for_whole_types(Make make) {
    std::string text;
    for (const std::string_view type : k_whole_vectors.first<8>())
        text += make(std::string(type), value_type(type)->rows);
    return text;
}

std::string part_of(std::string_view name, int size, int part) {
    return size == 1 ? std::string(name) : fmt::format("{}.{}", name, std::string_view("xyzw")[size_t(part)]);
}

/// Returns `NAME(y)` for whole numbers and their vectors, which checks each component before it is used: {0}
/// of `pattern` is the prefix, {1} the component, {2} its type.
std::string watched_parts(std::string_view prefix, std::string_view name, std::string_view pattern) {
    return for_whole_types([&](const std::string& type, int size) {
        std::string text = fmt::format("{0} {1}{2}({0} y,int i,inout float m){{", type, prefix, name);
        for (int part = 0; part < size; ++part)
            text += fmt::format(fmt::runtime(pattern), prefix, part_of("y", size, part),
                                type[0] == 'u' ? "uint" : "int");
        return text + "return y;}\n";
    });
}

/// Returns `$divisor(y)` for whole numbers: it replaces 0 by 1, because some drivers stop at a division by 0.
std::string divisors(std::string_view prefix) {
    return watched_parts(prefix, "divisor",
                         "{0}near(m,abs(float({1})));if(int({1})==0){{{0}whole(i,0,1u);{1}={2}(1);}}");
}

/// Returns `$remainder(x, y)` and `$dividend(x, y)`, which return x and note that it is negative; `$dividend`
/// only if the division leaves a remainder.
std::string dividends(std::string_view prefix) {
    std::string text;
    for (const auto& function : {std::pair("remainder", ""), {"dividend", "&&{1}-({1}/{2})*{2}!=0"}})
        text += for_whole_types([&, name = function.first, also = function.second](const std::string& type,
                                                                                   int size) {
            std::string overloads;
            for (const bool scalar : {true, false}) {
                if (!scalar && size == 1)
                    continue; // the same as with a scalar
                const std::string right = scalar ? std::string(type[0] == 'u' ? "uint" : "int") : type;
                overloads +=
                    fmt::format("{0} {1}{2}({0} x,{3} y,int i,inout float m){{", type, prefix, name, right);
                for (int part = 0; type[0] != 'u' && part < size; ++part) {
                    const std::string x = part_of("x", size, part), y = part_of("y", scalar ? 1 : size, part);
                    overloads += fmt::format("{0}near(m,float({1})+0.5);if({1}<0&&{2}!=0", prefix, x, y) +
                                 fmt::format(fmt::runtime(also), prefix, x, y) +
                                 fmt::format("){0}whole(i,{1},0u);", prefix, x);
                }
                overloads += "return x;}\n";
            }
            return overloads;
        });
    return text;
}

/// Returns quotients of whole numbers, a type that only the driver finds, and of matrices, which are not
/// watched.
std::string other_quotients(std::string_view prefix) {
    std::string text = divisors(prefix);
    const auto add = [&](const std::string& left, const std::string& right, const std::string& result,
                         bool whole) {
        text += fmt::format("{0} {1}quotient({2} x,{3} y,int i,inout float m){{return x/{4};}}\n", result,
                            prefix, left, right, whole ? fmt::format("{}divisor(y,i,m)", prefix) : "y");
    };
    for (const size_t kind : {0, 4}) {
        const std::string number(k_whole_vectors[kind]);
        add(number, number, number, true);
        for (const std::string_view type : k_whole_vectors.subspan(kind + 1, 3)) {
            const std::string vector(type);
            add(vector, vector, vector, true);
            add(vector, number, vector, true);
            add(number, vector, vector, true);
        }
    }
    for (int columns = 2; columns <= 4; ++columns)
        for (int rows = 2; rows <= 4; ++rows) {
            const std::string matrix = fmt::format("mat{}x{}", columns, rows);
            add(matrix, matrix, matrix, false);
            add(matrix, "float", matrix, false);
            add("float", matrix, matrix, false);
        }
    return text;
}

std::string shifts(std::string_view prefix) {
    return watched_parts(prefix, "shift",
                         "{0}near(m,min(float({1}),31.0-float({1}))+0.5);"
                         "if(uint({1})>31u){{{0}whole(i,int({1}),31u);if({0}number>=0){1}={2}(0);}}");
}

/// Returns an index inside the array: a write outside of it could hit any memory.
constexpr std::string_view k_index = R"(int $index(int x,int n,int i,inout float m){
$near(m,min(float(x),float(n-1)-float(x))+0.5);
if(x<0||x>=n){$whole(i,x,uint(n-1));x=$number==i?($value==1.0?n-1:0):clamp(x,0,n-1);}
return x;}
uint $index(uint x,int n,int i,inout float m){
$near(m,float(n-1)-float(x)+0.5);
if(x>=uint(n)){$whole(i,int(x),uint(n-1));x=$number==i&&$value!=1.0?0u:uint(n-1);}
return x;}
)";

/// Records the coordinate that is outside and its last valid value; a level below 0 with the limit
/// 0x10000000.
std::string fetches(std::string_view prefix) {
    std::string text;
    for (const auto& [sampler, place, z] :
         {std::array<std::string_view, 3>{"sampler2D", "ivec2", "0"}, {"sampler3D", "ivec3", "p.z"}})
        text += spell(fmt::format("vec4 $texelFetch({0} s,{1} p,int l,int i,inout float m){{{1} n="
                                  "textureSize(s,max(l,0));bool x=p.x<0||p.x>=n.x,y=p.y<0||p.y>=n.y;"
                                  "ivec2 o=x?ivec2(p.x,n.x):y?ivec2(p.y,n.y):ivec2({2},{3});"
                                  "$near(m,min(float(min(p.x,p.y)),float(min(n.x-p.x,n.y-p.y))-1.0)+0.5);{4}"
                                  "if(l<0){{$whole(i,l,0x10000000u);return vec4(0.0);}}"
                                  "if(x||y||{2}<0||{2}>={3}){{"
                                  "$whole(i,o.x,uint(max(o.y-1,0)));return vec4(0.0);}}"
                                  "return texelFetch(s,p,l);}}\n",
                                  sampler, place, z, z == "0" ? "1" : "n.z",
                                  z == "0" ? "" : "$near(m,min(float(p.z),float(n.z-p.z)-1.0)+0.5);"),
                      prefix, {});
    return text;
}

/// Returns `$toint(x)` and `$touint(x)`, which return their argument.
std::string conversions(std::string_view prefix) {
    std::string text;
    for (const auto& [name, low, high] :
         {std::array<std::string_view, 3>{"toint", "-2147483648.0", "2147483648.0"},
          {"touint", "-0.99999994", "4294967296.0"}}) {
        for (int size = 1; size <= 4; ++size) {
            text += fmt::format("{0} {1}{2}({0} x,int i,inout float m){{", k_float_vectors[size_t(size) - 1],
                                prefix, name);
            for (int part = 0; part < size; ++part)
                text += fmt::format("{0}near(m,min({1}-({2}),{3}-{1}));if(!({1}>={2}&&{1}<{3}))"
                                    "{0}undefined(i,{1},0.0);",
                                    prefix, part_of("x", size, part), low, high);
            text += "return x;}\n";
        }
        for (const std::string_view type : k_whole_vectors)
            text += fmt::format("{0} {1}{2}({0} x,int i,inout float m){{return x;}}\n", type, prefix, name);
    }
    return text;
}

constexpr std::pair<std::string_view, std::string_view> k_comparisons[] = {
    {"less", "<"}, {"less_equal", "<="}, {"greater", ">"}, {"greater_equal", ">="}};

std::string comparisons(std::string_view prefix) {
    constexpr std::pair<std::string_view, std::string_view> k_types[] = {
        {"float", "float"}, {"int", "int"}, {"uint", "uint"}, {"int", "uint"}, {"uint", "int"}};
    std::string text;
    for (const auto& [left, right] : k_types) {
        const std::string difference = left == "float" ? "a-b" : "float(a)-float(b)";
        const std::string common = left == right ? "a{}b" : "uint(a){}uint(b)";
        for (const auto& [name, op] : k_comparisons)
            text += fmt::format("bool {0}{1}({2} a,{3} b,inout float m,inout float k){{float d={4};"
                                "{0}near(m,d);{0}near(k,-d);return {5};}}\n",
                                prefix, name, left, right, difference, fmt::format(fmt::runtime(common), op));
        for (const auto& [name, op] : {std::pair("same", "=="), {"other", "!="}})
            text += fmt::format("bool {0}{1}({2} a,{3} b,inout float m,inout float k){{"
                                "{0}near(m,abs({4}));return {5};}}\n",
                                prefix, name, left, right, difference, fmt::format(fmt::runtime(common), op));
    }
    return text + fmt::format("bool {0}same(bool a,bool b,inout float m,inout float k){{return a==b;}}\n"
                              "bool {0}other(bool a,bool b,inout float m,inout float k){{return a!=b;}}\n",
                              prefix);
}

void fill(std::string& text, char hole, size_t number) {
    for (size_t at = text.find(hole); at != text.npos; at = text.find(hole, at))
        text.replace(at, 1, std::to_string(number));
}

} // namespace

/// Returns the functions to put before the text, limited to those that `sites` need.
std::string domain_prelude(const ParsedText& text, std::span<const DomainSite> sites,
                           const DomainPreludeOptions& options) {
    const std::string& prefix = options.prefix;
    std::vector<const BuiltinFunction*> used;
    bool kinds[10] = {};
    for (const DomainSite& site : sites) {
        kinds[size_t(site.kind)] = true;
        if (site.kind != DomainKind::function)
            continue;
        const BuiltinFunction* const function = find_builtin(called_name(text, site.node));
        if (std::ranges::find(used, function) == used.end())
            used.push_back(function);
    }
    const auto has = [&](DomainKind kind) { return kinds[size_t(kind)]; };
    std::string objectives(k_objectives);
    std::string basis(k_basis);
    for (std::string* each : {&basis, &objectives}) {
        fill(*each, '#', options.first_objective);
        fill(*each, '@', std::max<size_t>(options.objectives, 1));
        *each = spell(*each, prefix);
    }
    std::string prelude = basis + objectives;
    for (const BuiltinFunction* function : used)
        prelude += function->name == "normalize" ? normalize_overloads(prefix) : overloads(*function, prefix);
    if (has(DomainKind::quotient))
        prelude += float_quotients(prefix) + other_quotients(prefix);
    else if (has(DomainKind::divisor))
        prelude += divisors(prefix);
    if (has(DomainKind::whole))
        prelude += rounded_quotients(prefix, !text.is_es());
    if (has(DomainKind::negative))
        prelude += dividends(prefix);
    if (has(DomainKind::shift))
        prelude += shifts(prefix);
    if (has(DomainKind::index))
        prelude += spell(k_index, prefix);
    if (has(DomainKind::fetch))
        prelude += fetches(prefix);
    if (has(DomainKind::conversion))
        prelude += conversions(prefix);
    if (has(DomainKind::comparison))
        prelude += comparisons(prefix);
    return prelude;
}

/// Returns the `main` to put after the text, whose own `main` is renamed to `$main`.
std::string domain_main(std::string_view prefix) {
    return spell("\nvoid main(){$begin();$main();$flush();}\n", prefix);
}

namespace {

bool is_equality(std::string_view op) {
    return op == "==" || op == "!=";
}

std::string_view comparison_name(std::string_view op) {
    return op == "<"    ? "less"
           : op == "<=" ? "less_equal"
           : op == ">"  ? "greater"
           : op == ">=" ? "greater_equal"
           : op == "==" ? "same"
                        : "other";
}

class DomainWatcher {
public:
    DomainWatcher(const ParsedText& text, const TreeFacts& facts)
        : text_(text), tree_(text.tree()), facts_(facts), prefix_(fresh_prefix(text)), edits_(text) {}

    DomainWatch run(DomainScope scope) {
        DomainWatch result{{},
                           find_domain_sites(text_, facts_, scope),
                           {},
                           prefix_ + "number",
                           prefix_ + "value",
                           prefix_ + "stride",
                           prefix_ + "left",
                           prefix_ + "down",
                           prefix_ + "count",
                           prefix_ + "width"};
        for (size_t i = 0; i < result.sites.size(); ++i) {
            const DomainSite& site = result.sites[i];
            const bool compares = site.kind == DomainKind::comparison;
            const bool equality = compares && is_equality(text_.word_of(site.node));
            std::string last = compares ? std::string() : fmt::format(",{}", i);
            for (int way = 0; way <= int(compares); ++way) {
                const bool room =
                    result.objectives.size() < DomainLayout::k_most_objectives && !(equality && way > 0);
                last += room ? fmt::format(",{}m[{}]", prefix_, result.objectives.size())
                             : fmt::format(",{}none", prefix_);
                if (room)
                    result.objectives.push_back({i, way > 0, equality});
            }
            lead(site, last + ")");
        }
        lead_main();
        result.text =
            headers_with_buffers(text_) +
            domain_prelude(text_, result.sites,
                           {prefix_, result.objectives.size(), result.sites.size() * DomainLayout::k_site}) +
            edits_.text() + domain_main(prefix_);
        return result;
    }

private:
    /// Routes the site's operation through our function; `last` are the arguments to append.
    void lead(const DomainSite& site, const std::string& last) {
        const NodeId id = site.node;
        switch (site.kind) {
        case DomainKind::function:
        case DomainKind::fetch: return lead_call(id, last);
        case DomainKind::quotient: return lead_quotient(id, last);
        case DomainKind::whole: return lead_rounded(id, last);
        case DomainKind::negative: return lead_dividend(id, last);
        case DomainKind::divisor: return wrap(tree_.child(id, 1), "divisor", last);
        case DomainKind::shift: return wrap(tree_.child(id, 1), "shift", last);
        case DomainKind::conversion: return wrap(id, site.to_unsigned ? "touint" : "toint", last);
        case DomainKind::index:
            return wrap(tree_.child(id, 1), "index",
                        fmt::format(",int({}.length()){}", words_of(text_, tree_.child(id, 0)), last));
        case DomainKind::comparison:
            edits_.wrap(id, fmt::format("{}{}(", prefix_, comparison_name(text_.word_of(id))), last);
            edits_.replace(tree_[id].word, ",");
        }
    }

    void wrap(NodeId id, std::string_view function, const std::string& last) {
        edits_.wrap(id, fmt::format("{}{}((", prefix_, function), ")" + last);
    }

    void lead_call(NodeId id, const std::string& last) {
        edits_.replace(tree_[tree_.child(id, 0)].word, prefix_ + std::string(called_name(text_, id)));
        edits_.replace(tree_[id].end - 1, last);
    }

    void lead_quotient(NodeId id, const std::string& last) {
        const std::string function = prefix_ + std::string(k_quotient);
        if (tree_[id].kind == NodeKind::binary) {
            edits_.replace(tree_[id].word, ",");
            edits_.wrap(id, function + "(", last);
            return;
        }
        edits_.replace(tree_[id].word, fmt::format("={}({},", function, words_of(text_, tree_.child(id, 0))));
        edits_.wrap(tree_.child(id, 1), "(", ")" + last);
    }

    void lead_rounded(NodeId id, const std::string& last) {
        if (tree_[id].kind == NodeKind::call)
            return lead_call(id, last);
        edits_.replace(tree_[id].word, ",");
        edits_.wrap(id, prefix_ + "rounded(", last);
    }

    void lead_dividend(NodeId id, const std::string& last) {
        const NodeId left = tree_.child(id, 0), right = tree_.child(id, 1);
        const std::string function =
            prefix_ + (text_.word_of(id).starts_with('%') ? "remainder(" : "dividend(");
        const std::string divisor = fmt::format(",({}){}", words_of(text_, right), last);
        if (tree_[id].kind == NodeKind::binary)
            edits_.wrap(left, function + "(", ")" + divisor);
        else // `a %= b`: a stays a place to write to
            edits_.wrap(right, fmt::format("({}({}){},", function, words_of(text_, left), divisor), ")");
    }

    void lead_main() {
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
            const Node& node = tree_[id];
            if (node.kind == NodeKind::function && text_.word_of(id) == "main")
                edits_.replace(node.word, prefix_ + "main");
            else if (node.kind == NodeKind::name && text_.word_of(id) == "gl_FragCoord")
                edits_.replace(node.word, prefix_ + "place()");
            else if (node.kind == NodeKind::jump && text_.word_of(id) == "discard")
                edits_.wrap(id, fmt::format("{{{}flush();", prefix_), "}");
        }
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    std::string prefix_;
    SourceRewriter edits_;
};

uint32_t word(std::span<const uint32_t> words, size_t at) {
    return at < words.size() ? words[at] : 0;
}

} // namespace

size_t DomainWatch::words() const {
    return sites.size() * DomainLayout::k_site + objectives.size() * DomainLayout::k_objective;
}

DomainReading reading_of(const DomainWatch&, std::span<const uint32_t> words, size_t site) {
    const size_t at = site * DomainLayout::k_site;
    return {word(words, at), ~word(words, at + 1), std::rotr(word(words, at + 2), 1), word(words, at + 3)};
}

DomainRoom room_of(const DomainWatch& watch, std::span<const uint32_t> words, size_t objective) {
    const size_t at = watch.sites.size() * DomainLayout::k_site + objective * DomainLayout::k_objective;
    const uint32_t key = word(words, at);
    if (key == 0)
        return {std::numeric_limits<float>::infinity(), 0};
    const uint32_t bits = key >> 31 != 0 ? key : ~key & 0x7fffffffu;
    return {std::bit_cast<float>(bits), word(words, at + 1) % DomainLayout::k_most_pixels};
}

DomainWatch watch_domains(const ParsedText& text, const TreeFacts& facts, DomainScope scope) {
    return DomainWatcher(text, facts).run(scope);
}

std::string_view domain_fault(std::string_view name, float argument) {
    const BuiltinFunction* const function = find_builtin(name);
    if (!function || !function->domain)
        return "of 0 and 0"; // a quotient
    const Domain& domain = *function->domain;
    const UndefinedWhere* const broken =
        domain.broken(domain.argument == "y" ? Arguments{0, argument, 0} : Arguments{argument, 0, 0});
    return (broken ? broken : domain.undefined)->fault;
}

} // namespace tidemark::glsl
