// Cures: what is proposed for an operation, and where it comes to stand in its author's text.
#include "glsl_support.hpp"
#include "shader/fixes.hpp"
#include "shader/undefined_behaviour.hpp"

#include <gtest/gtest.h>

namespace tidemark::glsl::cure_test {

/// The text with the first guard of each site; a site without one is left.
std::string guarded(const std::string& text) {
    const auto read = parsed(text);
    const TreeFacts facts = find_facts(*read);
    std::vector<Cure> cures;
    for (const DomainSite& site : find_domain_sites(*read, facts, DomainScope::floats))
        if (auto found = domain_guards(*read, facts, site.node); !found.empty())
            cures.push_back(found.front());
    return cured(text, "a.glsl", cures).value_or("refused");
}

std::string in_main(const std::string& expression) {
    const std::string front = "uniform vec3 u;\nfloat own(float x);\nvoid main() { vec3 v = vec3(",
                      behind = "); }\n";
    const std::string text = guarded(front + expression + behind);
    return text.substr(front.size(), text.size() - front.size() - behind.size());
}

std::string with_values(const std::string& text) {
    const auto read = parsed(text);
    std::vector<Cure> cures;
    const TreeFacts facts = find_facts(*read);
    for (const Unassigned& each : find_unassigned(*read, facts))
        if (auto cure = initial_value(*read, facts, each))
            cures.push_back(*cure);
    return cured(text, "a.glsl", cures).value_or("refused");
}

TEST(Cure, AnArgumentIsKeptInItsDomain) {
    EXPECT_EQ(in_main("sqrt(u.x - 1.0)"), "sqrt(max(u.x - 1.0, 0.0))");
    EXPECT_EQ(in_main("pow(u.x, 2.2)"), "pow(max(u.x, 0.0), 2.2)");
    EXPECT_EQ(in_main("pow(u.x, 2.0)"), "pow(abs(u.x), 2.0)");
    EXPECT_EQ(in_main("acos( u.x )"), "acos( clamp(u.x, -1.0, 1.0) )");
}

TEST(Cure, ADivisorIsKeptAwayFromZero) {
    EXPECT_EQ(in_main("u / u.x"), "u / (u.x + (1.0 - abs(sign(u.x))) * 1e-18)");
    EXPECT_EQ(in_main("u / length(u)"), "u / max(length(u), 1e-18)");
    EXPECT_EQ(in_main("u / dot(u, u.zyx)"), "u / (dot(u, u.zyx) + (1.0 - abs(sign(dot(u, u.zyx)))) * 1e-18)");
    EXPECT_EQ(in_main("u / own(u.x)"), "u / own(u.x)") << "a call that may do something twice";
}

TEST(Cure, ACallIsChosenWhereItIsDefined) {
    EXPECT_EQ(in_main("normalize(u)"), "(dot(u, u) > 0.0 ? normalize(u) : u)");
    EXPECT_EQ(in_main("normalize(vec3(own(u.x)))"), "normalize(vec3(own(u.x)) + 1e-15)");
    EXPECT_EQ(in_main("smoothstep(u.x, u.y, 0.5)"),
              "(u.x != u.y ? smoothstep(u.x, u.y, 0.5) : step(u.x, 0.5))");
}

TEST(Cure, InnerWrapsAreInsideOuterWraps) {
    EXPECT_EQ(in_main("sqrt(u.x / u.y)"), "sqrt(max(u.x / (u.y + (1.0 - abs(sign(u.y))) * 1e-18), 0.0))");
    EXPECT_EQ(in_main("log(sqrt(u.x))"), "log(max(sqrt(max(u.x, 0.0)), 1e-30))");
}

TEST(Cure, AMacroIsChangedInItsBody) {
    EXPECT_EQ(guarded("#define R(x) sqrt(x)\n#define H 0.5\nuniform float u;\n"
                      "void main() { float f = R(u - H); }\n"),
              "#define R(x) sqrt(max(x, 0.0))\n#define H 0.5\nuniform float u;\n"
              "void main() { float f = R(u - H); }\n");
    EXPECT_EQ(guarded("#define H 0.5\nuniform float u;\nvoid main() { float f = sqrt(u - H); }\n"),
              "#define H 0.5\nuniform float u;\nvoid main() { float f = sqrt(max(u - H, 0.0)); }\n");
}

TEST(Cure, ZeroReplacesAMissingValue) {
    EXPECT_EQ(with_values("void main() { vec3 v, w; v += w; }\n"),
              "void main() { vec3 v = vec3(0.0), w = vec3(0.0); v += w; }\n");
    EXPECT_EQ(with_values("uniform float u;\nvoid f(out float x) { if (u > 0.0) x = 1.0; }\n"
                          "void main() { float y; f(y); }\n"),
              "uniform float u;\nvoid f(out float x) { x = 0.0; if (u > 0.0) x = 1.0; }\n"
              "void main() { float y; f(y); }\n");
    EXPECT_EQ(
        with_values("uniform float u;\nint f() { if (u > 0.0) return 1; }\nvoid main() { int y = f(); }\n"),
        "uniform float u;\nint f() { if (u > 0.0) return 1; return 0; }\nvoid main() { int y = f(); }\n");
    EXPECT_EQ(with_values("void main() { float a[2]; float b = a[0]; }\n"),
              "void main() { float a[2] = float[2](0.0, 0.0); float b = a[0]; }\n");
    const std::string types =
        "struct Light { vec3 colour; bool on; };\nstruct Hit { float t; Light lights[2]; mat2 turn; };\n";
    const std::string light = "Light(vec3(0.0), false)";
    EXPECT_EQ(with_values(types + "void main() { Hit h; float t = h.t; }\n"),
              types + "void main() { Hit h = Hit(0.0, Light[2](" + light + ", " + light +
                  "), mat2(0.0)); float t = h.t; }\n");
    EXPECT_EQ(with_values(types +
                          "const int N = 2;\nvoid f(out Light a[N]) {}\nvoid main() { Light a[N]; f(a); }\n"),
              types + "const int N = 2;\nvoid f(out Light a[N]) { a = Light[2](" + light + ", " + light +
                  ");}\nvoid main() { Light a[N]; f(a); }\n");
    EXPECT_EQ(with_values(types +
                          "uniform float u;\nLight f() { if (u > 0.0) return Light(vec3(u), true); }\n"
                          "void main() { Light a = f(); }\n"),
              types + "uniform float u;\nLight f() { if (u > 0.0) return Light(vec3(u), true); return " +
                  light + "; }\nvoid main() { Light a = f(); }\n");
    const std::string many = "void main() { float a[65]; float b = a[0]; }\n";
    EXPECT_EQ(with_values(many), many);
    const std::string hidden = "struct Ray { float t; };\nvoid main() { Ray Ray; float b = Ray.t; }\n";
    EXPECT_EQ(with_values(hidden), hidden);
}

TEST(Cure, TheLaterOfTwoEqualWrapsIsTheOuterWrap) {
    const WrittenWord x{{"a.glsl", 1, 1}, "x"};
    const Cure cures[]{{{{x, x, "abs(", ")"}}, ""}, {{{x, x, "max(", ", 1.0)"}}, ""}};
    EXPECT_EQ(cured("x;", "a.glsl", cures), "max(abs(x), 1.0);");
}

TEST(Cure, AChangedTextIsRefused) {
    const Cure cure{{{{{"a.glsl", 1, 7}, "x"}, {{"a.glsl", 2, 1}, "y"}, "(", ")"}}, ""};
    EXPECT_EQ(cured("float x +\ny;", "a.glsl", std::span(&cure, 1)), "float (x +\ny);");
    EXPECT_EQ(cured("float x +\nz;", "a.glsl", std::span(&cure, 1)), std::nullopt);
}

} // namespace tidemark::glsl::cure_test
