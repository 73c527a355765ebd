// Edges in the wrong order, coordinates that jump, whole quotients and negative dividends: what is found, and
// the fix.
#include "glsl_support.hpp"
#include "shader/fixes.hpp"
#include "shader/undefined_behaviour.hpp"

#include <gtest/gtest.h>

namespace tidemark::glsl::edges_test {

const std::string k_front = "uniform vec3 u;\nuniform int n;\nuniform sampler2D tex;\nvoid main() { ";

std::string fixed(const std::string& body, const std::vector<Cure>& cures) {
    const std::string text = cured(k_front + body + " }\n", "a.glsl", cures).value_or("refused");
    return text == "refused" ? text : text.substr(k_front.size(), text.size() - k_front.size() - 3);
}

std::string with_ordered_edges(const std::string& body) {
    const auto read = parsed(k_front + body + " }\n");
    const TreeFacts facts = find_facts(*read);
    std::vector<Cure> cures;
    for (const WrongEdges& each : find_wrong_edges(*read, facts))
        if (auto cure = ordered_edges(*read, facts, each))
            cures.push_back(*std::move(cure));
    return fixed(body, cures);
}

std::string without_seams(const std::string& body) {
    const auto read = parsed(k_front + body + " }\n");
    const TreeFacts facts = find_facts(*read);
    std::vector<Cure> cures;
    for (const JumpingLookUp& each :
         find_jumping_look_ups(*read, facts, [](std::string_view) { return true; }))
        if (auto cure = smooth_look_up(*read, facts, each))
            cures.push_back(*std::move(cure));
    return fixed(body, cures);
}

/// With the fix of every site of that kind.
std::string of_sites(DomainKind kind, const std::string& body) {
    const auto read = parsed(k_front + body + " }\n");
    const TreeFacts facts = find_facts(*read);
    std::vector<Cure> cures;
    for (const DomainSite& site : find_domain_sites(*read, facts, DomainScope::everything))
        if (site.kind == kind)
            if (auto cure = kind == DomainKind::whole ? between_whole_quotients(*read, facts, site.node)
                                                      : unsigned_dividend(*read, facts, site.node))
                cures.push_back(*std::move(cure));
    return fixed(body, cures);
}

TEST(Edges, WronglyOrderedConstantsAreSwapped) {
    EXPECT_EQ(with_ordered_edges("float f = smoothstep(0.5, 0.4, u.x);"),
              "float f = (1.0 - smoothstep(0.4, 0.5, u.x));");
    EXPECT_EQ(with_ordered_edges("float f = clamp(u.x, 1.0, 0.0);"), "float f = min(max(u.x, 1.0), 0.0);");
    EXPECT_EQ(with_ordered_edges("vec3 f = clamp(u, vec3(0.0, 1.0, 0.0), vec3(0.5));"),
              "vec3 f = min(max(u, vec3(0.0, 1.0, 0.0)), vec3(0.5));");
    EXPECT_EQ(with_ordered_edges("const float a = 0.2; float f = smoothstep(2.0 * a, a + 0.1, u.x);"),
              "const float a = 0.2; float f = (1.0 - smoothstep(a + 0.1, 2.0 * a, u.x));");
    EXPECT_EQ(with_ordered_edges("float f = smoothstep(0.5, 0.5, u.x);"),
              "float f = (0.5 != 0.5 ? smoothstep(0.5, 0.5, u.x) : step(0.5, u.x));");
}

TEST(Edges, OrderedAndUnknownEdgesAreKept) {
    for (const char* const body :
         {"float f = smoothstep(0.4, 0.5, u.x);", "float f = clamp(u.x, 0.0, 1.0);",
          "float f = clamp(u.x, u.y, 0.0);", "float e = 0.9; e = 0.1; float f = smoothstep(e, 0.5, u.x);",
          "float f = clamp(u.x, 0.5, 0.5);"})
        EXPECT_EQ(with_ordered_edges(body), body);
}

TEST(Seams, AreRemovedFromTheLookUp) {
    EXPECT_EQ(without_seams("vec4 c = texture(tex, fract(u.xy * 4.0));"),
              "vec4 c = textureGrad(tex, fract(u.xy * 4.0), dFdx((u.xy * 4.0)), dFdy((u.xy * 4.0)));");
    EXPECT_EQ(
        without_seams("vec2 q = floor(u.xy * 8.0) / 8.0; vec4 c = texture(tex, q);"),
        "vec2 q = floor(u.xy * 8.0) / 8.0; vec4 c = textureGrad(tex, q, dFdx(((0.0 * (u.xy * 8.0)) / 8.0)), "
        "dFdy(((0.0 * (u.xy * 8.0)) / 8.0)));");
    EXPECT_EQ(without_seams("vec4 c = texture(tex, vec2(atan(u.y, u.x), 0.5));"),
              "vec4 c = textureGrad(tex, vec2(atan(u.y, u.x), 0.5), "
              "mix(dFdx(vec2(atan(u.y, u.x), 0.5)), dFdx(vec2(atan(-(u.y), -(u.x)), 0.5)), "
              "step(dot(dFdx(vec2(atan(-(u.y), -(u.x)), 0.5)), dFdx(vec2(atan(-(u.y), -(u.x)), 0.5))), "
              "dot(dFdx(vec2(atan(u.y, u.x), 0.5)), dFdx(vec2(atan(u.y, u.x), 0.5))))), "
              "mix(dFdy(vec2(atan(u.y, u.x), 0.5)), dFdy(vec2(atan(-(u.y), -(u.x)), 0.5)), "
              "step(dot(dFdy(vec2(atan(-(u.y), -(u.x)), 0.5)), dFdy(vec2(atan(-(u.y), -(u.x)), 0.5))), "
              "dot(dFdy(vec2(atan(u.y, u.x), 0.5)), dFdy(vec2(atan(u.y, u.x), 0.5))))));");
}

TEST(Seams, AreNotFoundForSmoothOrUnknownCoordinates) {
    for (const char* const body :
         {"vec4 c = texture(tex, u.xy);", "vec4 c = texture(tex, sin(fract(u.xy)));",
          "vec4 c = textureLod(tex, fract(u.xy), 0.0);",
          "vec2 i = floor(u.xy), f = fract(u.xy); vec4 c = texture(tex, i + f * f * (3.0 - 2.0 * f));",
          "vec2 v = u.xy; vec2 q = fract(v); v += 1.0; vec4 c = texture(tex, q);"})
        EXPECT_EQ(without_seams(body), body);
}

TEST(WholeQuotients, AreShiftedByAHalfForIntegerDividends) {
    EXPECT_EQ(of_sites(DomainKind::whole, "float f = mod(floor(u.x), 7.0);"),
              "float f = (mod((floor(u.x) + 0.5), 7.0) - 0.5);");
    EXPECT_EQ(of_sites(DomainKind::whole, "float i = floor(u.x); float f = floor(i / 7.0);"),
              "float i = floor(u.x); float f = floor((i + 0.5) / 7.0);");
    for (const char* const body : {"float f = mod(u.x, 7.0);", "float f = mod(floor(u.x), 8.0);",
                                   "float f = floor(u.x) / 7.0;", "int f = n / 7;"})
        EXPECT_EQ(of_sites(DomainKind::whole, body), body);
}

TEST(NegativeDividends, AreDividedAsMagnitudes) {
    EXPECT_EQ(of_sites(DomainKind::negative, "int i = (n - 5) % 3;"),
              "int i = (sign(n - 5) * (abs((n - 5)) % 3));");
    EXPECT_EQ(of_sites(DomainKind::negative, "int i = 1 + n / 3;"), "int i = 1 + (sign(n) * (abs(n) / 3));");
    for (const char* const body : {"uint i = uint(n) % 3u;", "int i = 7 % 3;", "float f = u.x / 3.0;"})
        EXPECT_EQ(of_sites(DomainKind::negative, body), body);
}

} // namespace tidemark::glsl::edges_test
