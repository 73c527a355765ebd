#include "shader/token_reading.hpp"

#include <gtest/gtest.h>

#include <string>

namespace tidemark::glsl::preprocess_test {

/// How the word `here` fares in the text.
Activity at_here(const std::string& text) {
    const auto tokens = text::tokenize(text);
    const Preprocessed preprocessed = preprocess(tokens);
    for (size_t i = 0; i < tokens.size(); ++i)
        if (tokens[i].is("here"))
            return preprocessed.activity[i];
    ADD_FAILURE() << "no such word in " << text;
    return Activity::unknown;
}

Activity under(const std::string& condition) {
    return at_here(condition + "\nhere\n#endif\n");
}

TEST(Preprocess, conditions_over_numbers) {
    for (const char* condition :
         {"#if 1", "#if 2 > 1 && 3 >= 3", "#if (1 + 2 * 3) == 7", "#if 1 - 1 - 1 == -1", "#if !0",
          "#if ~0 == -1", "#if 0x10 == 16 && 010 == 8", "#if 1 << 4 == 16", "#if 7 % 4 == 3 && 7 / 4 == 1",
          "#if (6 & 3) == 2", "#if 1 || 0 && 0", "#if 5 != 6 // why", "#if /* so */ 1",
          "#if (1 | 2) == 3 && (3 ^ 1) == 2"})
        EXPECT_EQ(under(condition), Activity::active) << condition;
    for (const char* condition : {"#if 0", "#if 1 > 2", "#if 1 == 2 || 0", "#if !1", "#if 0 && (1 / 0)"})
        EXPECT_EQ(under(condition), Activity::inactive) << condition;
}

TEST(Preprocess, macros_of_the_site) {
    for (const char* condition :
         {"#ifdef GL_ES", "#if HW_PERFORMANCE", "#if HW_PERFORMANCE == 1 && defined GL_ES",
          "#if __VERSION__ == 300", "#ifdef GL_FRAGMENT_PRECISION_HIGH"})
        EXPECT_EQ(under(condition), Activity::active) << condition;
    for (const char* condition : {"#ifndef HW_PERFORMANCE", "#if __VERSION__ < 300", "#ifdef SHADERLAB"})
        EXPECT_EQ(under(condition), Activity::inactive) << condition;
}

TEST(Preprocess, macros_of_the_text) {
    EXPECT_EQ(under("#define A\n#ifdef A"), Activity::active);
    EXPECT_EQ(under("#define A\n#undef A\n#ifdef A"), Activity::inactive);
    EXPECT_EQ(under("#define A B + 1\n#define B 2\n#if A == 3"), Activity::active);
    EXPECT_EQ(under("#if NOT_DEFINED"), Activity::inactive);
    EXPECT_EQ(under("#if 0\n#define A\n#endif\n#ifdef A"), Activity::inactive);
}

TEST(Preprocess, unknown_conditions_are_unknown) {
    for (const char* condition :
         {"#ifdef GL_ARB_gpu_shader5", "#define F(x) x\n#if F(1)", "#if 1.5", "#if", "#if (1",
          "#define A A\n#if A", "#if 1 1", "#ifdef GL_ARB_gpu_shader5\n#define A\n#endif\n#ifdef A"})
        EXPECT_EQ(under(condition), Activity::unknown) << condition;
    EXPECT_EQ(under("#if defined(GL_ARB_gpu_shader5) && 0"), Activity::inactive);
    EXPECT_EQ(under("#if defined(GL_ARB_gpu_shader5) || 1"), Activity::active);
}

TEST(Preprocess, only_one_branch_of_a_group_is_active) {
    const auto group = [](const char* a, const char* b) {
        return std::string("#if ") + a + "\n1\n#elif " + b + "\nhere\n#else\n3\n#endif\n";
    };
    EXPECT_EQ(at_here(group("0", "1")), Activity::active);
    EXPECT_EQ(at_here(group("1", "1")), Activity::inactive);
    EXPECT_EQ(at_here(group("0", "0")), Activity::inactive);
    EXPECT_EQ(at_here(group("GL_X", "1")), Activity::unknown);
    EXPECT_EQ(at_here("#if 0\n#if 1\n#else\n#endif\n#else\nhere\n#endif\n"), Activity::active);
    EXPECT_EQ(at_here("#if 0\n#if 1\nhere\n#endif\n#endif\n"), Activity::inactive);
    EXPECT_EQ(at_here("#if 0\n#endif\nhere"), Activity::active);
}

TEST(Preprocess, survives_malformed_directives) {
    EXPECT_EQ(at_here("#endif\n#else\n#elif 1\nhere"), Activity::active);
    EXPECT_EQ(at_here("#if " + std::string(100'000, '(') + "\nhere"), Activity::unknown);
    EXPECT_EQ(at_here("#if " + std::string(100'000, '!') + "1\nhere"), Activity::unknown);
    std::string bomb = "#define A0 1\n";
    for (int i = 1; i < 50; ++i)
        bomb += "#define A" + std::to_string(i) + " A" + std::to_string(i - 1) + " + A" +
                std::to_string(i - 1) + "\n";
    EXPECT_EQ(at_here(bomb + "#if A49\nhere"), Activity::unknown);
    EXPECT_EQ(at_here("#\n#define\n#define F(\nhere"), Activity::active);
}

TEST(Preprocess, code_and_macros_are_listed) {
    const std::string text = "a\n#define F(x, y) x y\n#if 0\nb\n#define G\n#endif\n#undef F\n#pragma p\nc\n";
    const auto tokens = text::tokenize(text);
    const Preprocessed preprocessed = preprocess(tokens);
    ASSERT_EQ(preprocessed.code.size(), 2u);
    EXPECT_TRUE(tokens[preprocessed.code[1]].is("c"));
    ASSERT_EQ(preprocessed.macros.size(), 2u);
    EXPECT_TRUE(preprocessed.macros[0].parameters);
    EXPECT_TRUE(tokens[preprocessed.macros[0].body].is("x"));
    EXPECT_EQ(preprocessed.macros[0].end - preprocessed.macros[0].body, 2u);
    EXPECT_TRUE(preprocessed.macros[1].undefines);
    EXPECT_EQ(preprocessed.directives.size(), 1u);
}

} // namespace tidemark::glsl::preprocess_test
