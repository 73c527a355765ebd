#include "ir_support.hpp"

#include <gmock/gmock.h>

namespace tidemark::proof::spirv_test {

TEST(Spirv, a_text_becomes_one_function_without_calls) {
    const Function function =
        compiled("float twice(float a) { return 2.0 * a; }", "color = vec4(twice(iTime));");
    EXPECT_EQ(function.blocks.size(), 1u);
    ASSERT_NE(function.find("color"), nullptr);
    EXPECT_EQ(function.find("color")->size, 4u);
    EXPECT_EQ(function.find("iTime")->kind, Variable::Kind::uniform);
}

TEST(Spirv, instructions_have_the_lines_of_the_text) {
    const Function function = compiled("", "float a = iTime;\n\na = sin(a);\ncolor = vec4(a);");
    bool found = false;
    for (const Instruction& instruction : function.instructions)
        if (instruction.op == Op::sin) {
            EXPECT_EQ(instruction.line, 9);
            found = true;
        }
    EXPECT_TRUE(found);
}

TEST(Spirv, compiler_errors_have_their_line) {
    const auto refused = compile(shader("", "color = nothing;"));
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, testing::HasSubstr("0:7: 'nothing' : undeclared identifier"));
}

TEST(Spirv, unsupported_code_is_named_with_its_line) {
    const auto doubles = compile(shader("", "double a = iTime;\ncolor = vec4(float(a));"));
    ASSERT_FALSE(doubles);
    EXPECT_THAT(doubles.error().message, testing::HasSubstr("numbers of other than 32 bits"));
}

TEST(Spirv, invalid_modules_are_refused) {
    const std::vector<uint32_t> words(100, 0x00030011);
    EXPECT_FALSE(read_spirv(words));
    EXPECT_TRUE(read_spirv({}));
}

} // namespace tidemark::proof::spirv_test
