#include "glsl_support.hpp"
#include "shader/tree_facts.hpp"

#include <gtest/gtest.h>

namespace tidemark::glsl::expression_type_test {

/// Returns the type of the expression that the function g returns; empty if it is unknown.
std::string type_of(const std::string& expression) {
    const auto read = parsed(
        "uniform sampler2D s;\nuniform mat3 turn;\nstruct Ray { vec3 o; };\nfloat twice = 2.0;\n"
        "vec2 own(vec2 p) { return p; }\nfloat two(int x) { return 1.0; }\nint two(float x) { return 1; }\n"
        "Ray cast(vec3 p) { return Ray(p); }\nvec2 some(vec2 p) { return p; }\nvec3 some(vec3 p) { return p; "
        "}\n"
        "float some(vec3 p, vec3 q) { return 1.0; }\nfloat three(int x) { return 1.0; }\n"
        "vec2 three(ivec2 x) { return vec2(x); }\nstruct Ball { float r; };\n"
        "float four(Ray r) { return 1.0; }\nvec2 four(Ball b) { return vec2(b.r); }\n"
        "vec3 four(float a[3]) { return vec3(a[0]); }\n"
        "float five(float a, float b) { return a; }\nvec3 five(vec3 a, float b) { return a; }\n"
        "void f(float twice) { vec4 v; float a[3]; Ray ray; float d; { vec2 d; } int n; }\n"
        "float g(vec3 p, float x) { ivec2 i; float a[3]; Ray ray; Ray many[2];\n"
        "{ vec2 same; } { vec2 same; } { vec2 other; } { float other; } return " +
        expression + "; }\n");
    const SyntaxTree& tree = read->tree();
    const TreeFacts facts = find_facts(*read);
    std::string found = "no return";
    for (NodeId id = 1; id < tree.nodes.size(); ++id)
        if (tree[id].kind == NodeKind::return_statement) {
            const auto type = expression_type(*read, facts, tree.child(id, 0));
            found = type ? to_string(*type) : "";
        }
    return found;
}

TEST(ExpressionType, FollowsDeclarationsAndFunctions) {
    EXPECT_EQ(type_of("1.0"), "float");
    EXPECT_EQ(type_of("p"), "vec3");
    EXPECT_EQ(type_of("-p.xz"), "vec2");
    EXPECT_EQ(type_of("2.0 * p"), "vec3");
    EXPECT_EQ(type_of("turn * p"), "vec3");
    EXPECT_EQ(type_of("(x > 1.0 ? p : p + 1.0)"), "vec3");
    EXPECT_EQ(type_of("length(p)"), "float");
    EXPECT_EQ(type_of("own(p.xy).yx"), "vec2");
    EXPECT_EQ(type_of("texture(s, p.xy).rgb"), "vec3");
    EXPECT_EQ(type_of("vec4(p, 1.0)"), "vec4");
    EXPECT_EQ(type_of("fwidth(p)"), "vec3");
    EXPECT_EQ(type_of("i + 1"), "ivec2");
    EXPECT_EQ(type_of("twice"), "float"); // f has another one
    EXPECT_EQ(type_of("ray.o"), "vec3");
    EXPECT_EQ(type_of("many[1].o.xy"), "vec2");
    EXPECT_EQ(type_of("Ray(p).o"), "vec3");
    EXPECT_EQ(type_of("cast(p).o.x"), "float");
    EXPECT_EQ(type_of("a[1]"), "float");
    EXPECT_EQ(type_of("p[1]"), "float");
    EXPECT_EQ(type_of("turn[1]"), "vec3");
    EXPECT_EQ(type_of("turn[1][0]"), "float");
    EXPECT_EQ(type_of("same"), "vec2");
    EXPECT_EQ(type_of("two(1)"), "float");
    EXPECT_EQ(type_of("some(p)"), "vec3");
    EXPECT_EQ(type_of("some(p.xy)"), "vec2");
    EXPECT_EQ(type_of("some(p, p)"), "float");
    EXPECT_EQ(type_of("four(ray)"), "float");
    EXPECT_EQ(type_of("four(cast(p))"), "float");
    EXPECT_EQ(type_of("four(Ball(x))"), "vec2");
    EXPECT_EQ(type_of("four(a)"), "vec3");
    EXPECT_EQ(type_of("five(p, 1)"), "vec3"); // 1 becomes a float
}

TEST(ExpressionType, FollowsOperatorsOfWholeNumbersTestsAndAssignments) {
    EXPECT_EQ(type_of("7 % 3"), "int");
    EXPECT_EQ(type_of("i % 3"), "ivec2");
    EXPECT_EQ(type_of("7 % i"), "ivec2");
    EXPECT_EQ(type_of("(7u & 3u | 4u) ^ 1u"), "uint");
    EXPECT_EQ(type_of("i << 2"), "ivec2");
    EXPECT_EQ(type_of("7u >> 2"), "uint");
    EXPECT_EQ(type_of("x < 1.0 && missing"), "bool");
    EXPECT_EQ(type_of("missing == p"), "bool");
    EXPECT_EQ(type_of("(x += 1.0)"), "float");
    EXPECT_EQ(type_of("(x += 1.0, p)"), "vec3");
    EXPECT_EQ(type_of("a.length()"), "int");
    EXPECT_EQ(type_of("7 % 3u"), ""); // drivers differ in whether 7 becomes unsigned
    EXPECT_EQ(type_of("7 % missing"), "");
    EXPECT_EQ(type_of("x % 3"), "");
    EXPECT_EQ(type_of("i % ivec3(3)"), "");
}

TEST(ExpressionType, NestedCallsAreTypedOnce) {
    std::string nested = "missing";
    for (int i = 0; i < 50; ++i)
        nested = "some(" + nested + ")";
    EXPECT_EQ(type_of(nested), ""); // within a second, not 2^50 steps
}

TEST(ExpressionType, IsUnknownWithoutADeclaration) {
    EXPECT_EQ(type_of("ray"), "");
    EXPECT_EQ(type_of("ray.missing"), "");
    EXPECT_EQ(type_of("a"), "");
    EXPECT_EQ(type_of("many[1]"), "");
    EXPECT_EQ(type_of("other"), "");
    EXPECT_EQ(type_of("some(missing)"), ""); // its overloads differ
    EXPECT_EQ(type_of("three(missing)"), "");
    EXPECT_EQ(type_of("four(missing)"), "");
    EXPECT_EQ(type_of("missing"), "");
    EXPECT_EQ(type_of("missing(p)"), "");
}

} // namespace tidemark::glsl::expression_type_test
