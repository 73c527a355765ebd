#include "shader/rewrite.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tidemark::glsl::overloads_test {

struct Joined {
    std::string functions;
    std::string text;
};

Joined join(const std::string& text) {
    const auto tokens = text::tokenize(text);
    auto [functions, edits] = join_overloads(tokens, preprocess(tokens));
    text::MappedText mapped;
    mapped.append(text, "a.glsl", 1);
    mapped.apply(edits);
    return {functions, mapped.text()};
}

bool overloads(const std::string& text) {
    const auto tokens = text::tokenize(text);
    return overloads_builtins(tokens, preprocess(tokens));
}

TEST(Overloads, definitions_and_calls_are_renamed_together) {
    const auto [functions, text] =
        join("struct S { float cross; };\n"
             "#define C(a) cross(a, a)\n"
             "float cross(vec2 a) { return a.x; }\n"
             "float f(S s, float dot) { return s.cross + cross(vec3(1), vec3(dot)).x; }\n");
    EXPECT_EQ(functions, "vec3 st_cross(vec3 a, vec3 b) { return cross(a, b); }\n");
    EXPECT_EQ(text, "struct S { float cross; };\n"
                    "#define C(a) st_cross(a, a)\n"
                    "float st_cross(vec2 a) { return a.x; }\n"
                    "float f(S s, float dot) { return s.cross + st_cross(vec3(1), vec3(dot)).x; }\n");
}

TEST(Overloads, an_authors_signature_replaces_the_built_in_signature) {
    const std::string functions =
        join("vec3 mod(vec3 a, float b);\nvec3 mod(vec3 a, float b) { return a; }\n").functions;
    EXPECT_EQ(functions, "float st_mod(float a, float b) { return mod(a, b); }\n"
                         "vec2 st_mod(vec2 a, vec2 b) { return mod(a, b); }\n"
                         "vec3 st_mod(vec3 a, vec3 b) { return mod(a, b); }\n"
                         "vec4 st_mod(vec4 a, vec4 b) { return mod(a, b); }\n"
                         "vec2 st_mod(vec2 a, float b) { return mod(a, b); }\n"
                         "vec4 st_mod(vec4 a, float b) { return mod(a, b); }\n");
}

TEST(Overloads, out_arguments_of_built_ins_are_written) {
    EXPECT_THAT(join("float modf(float a) { return a; }").functions,
                testing::StartsWith("float st_modf(float a, out float b) { return modf(a, b); }\n"));
}

TEST(Overloads, ordinary_texts_have_no_overloads) {
    EXPECT_FALSE(overloads("float f(float mix) { return mix(1.0, 2.0, 0.5); }"));
    EXPECT_FALSE(overloads("#if 0\nfloat mix(vec2 a) { return a.x; }\n#endif\n"));
    EXPECT_TRUE(overloads("float mix(vec2 a) { return a.x; }"));
    EXPECT_TRUE(overloads("uint packHalf2x16(float a) { return uint(a); }"));
    EXPECT_FALSE(overloads("float fma(vec2 a) { return a.x; }"));             // the site has no such function
    EXPECT_FALSE(overloads("vec4 textureOffset(vec2 a) { return a.xyxy; }")); // its offset must stay constant
    EXPECT_EQ(join("float f() { return mix(1.0, 2.0, 0.5); }").functions, "");
}

} // namespace tidemark::glsl::overloads_test
