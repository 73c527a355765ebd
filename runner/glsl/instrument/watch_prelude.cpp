#include "glsl/instrument/watch_prelude.hpp"

#include "glsl/instrument/source_rewriter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace tidemark::glsl {
namespace {

constexpr std::array<std::string_view, 4> k_doubles{"double", "dvec2", "dvec3", "dvec4"};

constexpr std::string_view k_any_bad =
    R"(bool $bad(float v){return (floatBitsToUint(v)&0x7f800000u)==0x7f800000u;}
)";
constexpr std::string_view k_nan_bad =
    R"(bool $bad(float v){return (floatBitsToUint(v)&0x7fffffffu)>0x7f800000u;}
)";
constexpr std::string_view k_bad_vectors = R"(bool $bad(vec2 v){return $bad(v.x)||$bad(v.y);}
bool $bad(vec3 v){return $bad(v.x)||$bad(v.y)||$bad(v.z);}
bool $bad(vec4 v){return $bad(v.x)||$bad(v.y)||$bad(v.z)||$bad(v.w);}
float $mend(float v){return $bad(v)?0.5:v;}
vec2 $mend(vec2 v){return vec2($mend(v.x),$mend(v.y));}
vec3 $mend(vec3 v){return vec3($mend(v.x),$mend(v.y),$mend(v.z));}
vec4 $mend(vec4 v){return vec4($mend(v.xy),$mend(v.zw));}
)";

/// Without operands to record, a hit is one assignment: the driver has no branch to follow.
constexpr std::string_view k_probe = "@ $P(@ v,int i){$h=$h==0&&$bad(v)?i:$h;return v;}\n";
constexpr std::string_view k_recording_probe =
    "@ $P(@ v,int i){if($h==0&&$bad(v)){$h=i;$store(2,v);$leave();}return v;}\n";
constexpr std::string_view k_no_probe = "@ $P(@ v,int i){return v;}\n";
constexpr std::string_view k_repair = "@ $R(@ v){return $mend(v);}\n";
constexpr std::string_view k_no_repair = "@ $R(@ v){return v;}\n";
constexpr std::string_view k_capture = "@ $C(@ v,int k){if($h==0)$store(k,v);return v;}\n";
constexpr std::string_view k_pop = "@ $K(int n,@ v){--$depth;return v;}\n";

/// Returns the function that stores a value of `type` in a slot: its code, then its numbers as bits.
std::string store(std::string_view prefix, std::string_view type, int code, int components) {
    constexpr std::string_view k_parts = "xyzw";
    const std::string_view to_bits = type == "float" || type.starts_with("vec") ? "floatBitsToUint" : "uint";
    std::string text = fmt::format("void {0}store(int k,{1} v){{{0}out[k]={2}u;", prefix, type, code);
    for (int i = 0; i < components; ++i)
        text += fmt::format("{}out[k+{}]={}(v{});", prefix, i + 1, to_bits,
                            components == 1 ? std::string() : fmt::format(".{}", k_parts[size_t(i)]));
    return text + "}\n";
}

std::string store_matrix(std::string_view prefix, int columns, int rows) {
    std::string text = fmt::format("void {0}store(int k,mat{1}x{2} v){{{0}out[k]={3}u;", prefix, columns,
                                   rows, k_matrix_slot + 10 * columns + rows);
    for (int i = 0; i < columns * rows; ++i)
        text += fmt::format("{}out[k+{}]=floatBitsToUint(v[{}][{}]);", prefix, i + 1, i / rows, i % rows);
    return text + "}\n";
}

std::string matrix_functions(std::string_view prefix, int columns, int rows) {
    std::string bad;
    std::string mended;
    for (int i = 0; i < columns; ++i) {
        bad += fmt::format("{}{}bad(v[{}])", i > 0 ? "||" : "", prefix, i);
        mended += fmt::format("{}{}mend(v[{}])", i > 0 ? "," : "", prefix, i);
    }
    return fmt::format("bool {0}bad(mat{1}x{2} v){{return {3};}}\nmat{1}x{2} {0}mend(mat{1}x{2} v){{return "
                       "mat{1}x{2}({4});}}\n",
                       prefix, columns, rows, bad, mended);
}

class Prelude {
public:
    explicit Prelude(const PreludeOptions& options) : options_(options) {}

    std::string run() {
        add("layout(std430,binding=0) buffer $Buffer{uint $out[];};\nint $h=0;\n", {});
        if (options_.repair)
            add("int $iterations=0;\n", {});
        add(options_.nan_only ? k_nan_bad : k_any_bad, {});
        add(k_bad_vectors, {});
        for_each_matrix([&](int c, int r) { text_ += matrix_functions(options_.prefix, c, r); });
        if (options_.capture)
            add_records();
        for (const auto type : k_float_vectors)
            add_type(type, true);
        for_each_matrix([&](int c, int r) { add_type(fmt::format("mat{}x{}", c, r), true); });
        for (const auto type : k_whole_vectors)
            add_type(type, false);
        if (options_.doubles)
            for (const auto type : k_doubles)
                add_type(type, false);
        return std::move(text_);
    }

private:
    void add(std::string_view pattern, std::string_view type) {
        text_ += spell(pattern, options_.prefix, type);
    }

    template <class F>
    static void for_each_matrix(F&& use) {
        for (int columns = 2; columns <= 4; ++columns)
            for (int rows = 2; rows <= 4; ++rows)
                use(columns, rows);
    }

    void add_records() {
        add("int $depth=0;\n", {});
        for (size_t i = 0; i < options_.loops; ++i)
            text_ += fmt::format("int {}L{}=0;\n", options_.prefix, i);
        add(fmt::format("int $push(int site){{if($h==0&&$depth<{})$out[{}+$depth]=uint(site);return "
                        "$depth++;}}\nvoid $pop(){{--$depth;}}\n",
                        WatchLayout::k_most_calls, WatchLayout::k_path),
            {});
        text_ += spell(fmt::format("void $leave(){{$out[{}]=uint($depth);", WatchLayout::k_depth),
                       options_.prefix, {});
        for (size_t i = 0; i < options_.loops; ++i)
            text_ +=
                spell(fmt::format("$out[{}]=uint($L{});", WatchLayout::k_loops + i, i), options_.prefix, {});
        text_ += "}\n";
        for (size_t i = 0; i < std::size(k_vectors); ++i)
            text_ += store(options_.prefix, k_vectors[i], int(i) + 1, int(i % 4) + 1);
        for_each_matrix([&](int c, int r) { text_ += store_matrix(options_.prefix, c, r); });
    }

    void add_type(std::string_view type, bool floating) {
        const bool is_double = type[0] == 'd';
        add(!floating ? k_no_probe : options_.capture ? k_recording_probe : k_probe, type);
        if (options_.repair)
            add(floating ? k_repair : k_no_repair, type);
        if (options_.capture) {
            add(is_double ? "@ $C(@ v,int k){return v;}\n" : k_capture, type);
            add(k_pop, type);
        }
    }

    const PreludeOptions& options_;
    std::string text_;
};

} // namespace

std::string watch_prelude(const PreludeOptions& options) {
    return Prelude(options).run();
}

std::string structure_overloads(const PreludeOptions& options, const TreeFacts& facts,
                                std::string_view name) {
    std::string bad;
    for (const StructureMember& member : facts.structures.at(name))
        if (!member.array && (class_of_type(member.type) == TypeClass::floating ||
                              (facts.structures.contains(member.type) && member.type != name)))
            bad += fmt::format("||{}bad(v.{})", options.prefix, member.name);
    std::string text = spell(fmt::format("bool $bad(@ v){{return false{};}}\n", bad), options.prefix, name);
    text +=
        spell(options.capture ? "@ $P(@ v,int i){if($h==0&&$bad(v)){$h=i;$leave();}return v;}\n" : k_probe,
              options.prefix, name);
    if (options.repair)
        text += spell(k_no_repair, options.prefix, name);
    if (options.capture)
        text += spell(k_pop, options.prefix, name);
    return text;
}

std::optional<ValueType> slot_type(unsigned code) {
    if (code >= k_matrix_slot + 22 && code <= k_matrix_slot + 44)
        return ValueType{'f', int(code - k_matrix_slot) / 10, int(code - k_matrix_slot) % 10};
    return code >= 1 && code <= std::size(k_vectors) ? value_type(k_vectors[code - 1]) : std::nullopt;
}

} // namespace tidemark::glsl
