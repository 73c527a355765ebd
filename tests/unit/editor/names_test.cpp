#include "editor/workspace.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace tidemark::lsp::names_test {

using testing::ElementsAre;
using testing::IsEmpty;

/// Returns the type of the local that `name` means at the `|` of a text; empty if it means none.
std::string type_at(std::string text, std::string_view name) {
    const size_t offset = text.find('|');
    text.erase(offset, 1);
    const FileNames names(text);
    const Local* const local = names.local(name, offset);
    return local ? std::string(local->type) + (local->array ? "[]" : "") : "";
}

std::vector<size_t> uses_in(std::string_view text, std::string_view name) {
    std::vector<size_t> offsets;
    const FileNames names(text);
    for (const size_t token : names.uses(name))
        offsets.push_back(names.tokens()[token].begin);
    return offsets;
}

TEST(FileNames, finds_locals_in_their_scope) {
    EXPECT_EQ(type_at("void f(vec3 a) { | }", "a"), "vec3");
    EXPECT_EQ(type_at("void f(const in float a[3]) { | }", "a"), "float[]");
    EXPECT_EQ(type_at("void f(vec3 a) { } void g() { | }", "a"), "");
    EXPECT_EQ(type_at("void f() { { int a; } | }", "a"), "");
    EXPECT_EQ(type_at("void f() { int a; { float a; } | }", "a"), "int");
    EXPECT_EQ(type_at("void f() { int a; { float a; | } }", "a"), "float");
    EXPECT_EQ(type_at("void f() { vec2 a = vec2(1, 2), b[2]; | }", "b"), "vec2[]");
    EXPECT_EQ(type_at("void f() { highp vec2[2] a; | }", "a"), "vec2[]");
    EXPECT_EQ(type_at("void f() { if (x) y = 1; else { Ray r; | } }", "r"), "Ray");
}

TEST(FileNames, finds_the_variables_of_loops) {
    EXPECT_EQ(type_at("void f() { for (int i = 0; i < 3; ++i) { | } }", "i"), "int");
    EXPECT_EQ(type_at("void f() { for (int i = 0; i < 3; ++i) g(|i); }", "i"), "int");
    EXPECT_EQ(type_at("void f() { for (int i = 0; i < 3; ++i) g(i); | }", "i"), "");
    EXPECT_EQ(type_at("void f() { for (int i = 0;;) if (i > 2) g(i); else h(|i); }", "i"), "int");
    EXPECT_EQ(type_at("void f() { for (int i = 0;;) if (i > 2) g(i); else h(i); | }", "i"), "");
}

TEST(FileNames, begins_a_scope_after_the_initialiser) {
    EXPECT_EQ(type_at("void f(float x) { { int x = int(|x); } }", "x"), "float");
    EXPECT_EQ(type_at("void f(float x) { { int x = int(x), y = |x; } }", "x"), "int");
}

TEST(FileNames, finds_uses_of_a_global_name) {
    EXPECT_THAT(uses_in("float a; void f() { a = 1.0; }", "a"), ElementsAre(6u, 20u));
    EXPECT_THAT(uses_in("void f(float a) { a = b.a; }", "a"), IsEmpty());
    EXPECT_THAT(uses_in("struct S { float a; };", "a"), IsEmpty());
    EXPECT_THAT(uses_in("#define M(a) (a + b)\n#define N a\n", "a"), ElementsAre(31u));
}

TEST(FileNames, reads_the_members_of_structures) {
    const FileNames names("struct Ray { vec3 from, to; float t[2]; };");
    ASSERT_EQ(names.members().size(), 3u);
    EXPECT_EQ(names.members()[1].structure, "Ray");
    EXPECT_EQ(names.members()[1].name, "to");
    EXPECT_EQ(names.members()[1].type, "vec3");
    EXPECT_TRUE(names.members()[2].array);
}

TEST(FileNames, accepts_malformed_texts) {
    for (const char* text :
         {"", "{", "}", "void f(", "void f() {", "void f() { for (", "struct S {", "#define", "#define M(",
          "void f() { int a", "void f() { if (a) else", "void f() { do", "float f(float", "struct { float"})
        for (const char* name : {"a", "f", ""})
            EXPECT_EQ(FileNames(text).local(name, 3), nullptr) << text;
}

} // namespace tidemark::lsp::names_test
