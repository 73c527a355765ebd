#include "editor/workspace.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tidemark::lsp::outline_test {

using testing::ElementsAre;
using Kind = Symbol::Kind;

std::vector<std::pair<Kind, std::string>> kinds_in(std::string_view text) {
    std::vector<std::pair<Kind, std::string>> found;
    for (const Symbol& symbol : outline(text))
        found.emplace_back(symbol.kind, symbol.name);
    return found;
}

TEST(Outline, lists_global_declarations) {
    EXPECT_THAT(kinds_in("#define PI 3.14\n"
                         "#define SQUARE(x) ((x) * (x))\n"
                         "#iUniform float speed = 1.0 in { 0.0, 2.0 }\n"
                         "const highp float a = 1.0, b[2] = float[2](1.0, 2.0);\n"
                         "precision mediump float;\n"
                         "vec3 c, d;\n"
                         "struct Ray { vec3 from; vec3 to; } ray;\n"
                         "float announced(vec3 p);\n"
                         "float sdf(vec3 p) { float inner = 1.0; return inner; }\n"
                         "float last = sdf(vec3(1.0, 2.0, 3.0));\n"),
                ElementsAre(std::pair(Kind::macro, "PI"), std::pair(Kind::macro, "SQUARE"),
                            std::pair(Kind::knob, "speed"), std::pair(Kind::constant, "a"),
                            std::pair(Kind::constant, "b"), std::pair(Kind::variable, "c"),
                            std::pair(Kind::variable, "d"), std::pair(Kind::structure, "Ray"),
                            std::pair(Kind::function, "sdf"), std::pair(Kind::variable, "last")));
}

TEST(Outline, has_the_signature_on_one_line_and_the_comment_above) {
    const auto found =
        outline("/** How far\n *  it is. */\nfloat sdf(vec3 p,\n          float r) { return 1.0; }\n");
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].signature, "float sdf(vec3 p, float r)");
    EXPECT_EQ(found[0].comment, "How far\nit is.");
}

TEST(Outline, accepts_any_bytes) {
    for (const char* text : {"", "{", "}", "float", "float x", "const", "struct", "#define", "#iUniform",
                             "#iUniform float", "(;", "float f(", "vec3 a[", ";;;", "float a,,b;", "\xff"})
        outline(text);
}

TEST(Comments, above_a_declaration_are_found) {
    const std::string_view text = "int a; // of a\n// one\n// two\nint b;\n\nint c; /* of c */\nint d;\n";
    EXPECT_EQ(comment_above(text, text.find("int b")), "one\ntwo");
    EXPECT_EQ(comment_above(text, text.find("int c")), "");
    EXPECT_EQ(comment_above(text, text.find("int d")), "");
    EXPECT_EQ(comment_above(text, 0), "");
    EXPECT_EQ(comment_above("// first\nint a;", 10), "first");
    EXPECT_EQ(comment_above("\nint a;", 2), "");
    EXPECT_EQ(comment_above("/* a\nb */\nint a;", 11), "a\nb");
    EXPECT_EQ(comment_above("int a; /* a\nb */\nint b;", 17), "");
}

TEST(Comments, leading_comment_of_a_text) {
    EXPECT_EQ(leading_comment("// a\n// b\n\nint c;"), "a\nb");
    EXPECT_EQ(leading_comment("/* a\n * b\n */\nint c;"), "a\nb");
    EXPECT_EQ(leading_comment("int c; // d"), "");
    EXPECT_EQ(leading_comment(""), "");
    EXPECT_EQ(leading_comment("/* a"), "a");
}

} // namespace tidemark::lsp::outline_test
