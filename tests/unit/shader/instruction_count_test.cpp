// Lines in the forms that drivers are known to write, and lines that only look like them.
#include "shader/driver_log.hpp"

#include <gtest/gtest.h>

namespace tidemark::glsl::instruction_count_test {

std::string read(std::string_view message) {
    const auto count = read_instruction_count(message);
    return count ? count->shader + " = " + std::to_string(count->instructions) : "nothing";
}

TEST(InstructionCount, intel) {
    EXPECT_EQ(
        read("FS SIMD8 shader: 1234 inst, 5 loops, 98765 cycles, 0:0 spills:fills, 7 sends, scheduled with "
             "mode top-down, Promoted 3 constants, compacted 19744 to 14048 bytes."),
        "FS SIMD8 = 1234");
    EXPECT_EQ(
        read("VS vec4 shader: 9 inst, 0 loops, 30 cycles, 0:0 spills:fills, 1 sends, compacted 144 to 96 "
             "bytes.\n"),
        "VS vec4 = 9");
}

TEST(InstructionCount, mobile) {
    EXPECT_EQ(read("FRAG shader: 310 inst, 40 nops, 270 non-nops, 12 mov, 3 cov"), "FRAG = 310");
    EXPECT_EQ(read("MESA_SHADER_FRAGMENT prog 3/1: 88 instructions, 2 threads, 1 loops"),
              "MESA_SHADER_FRAGMENT prog 3/1 = 88");
}

TEST(InstructionCount, nouveau) {
    EXPECT_EQ(read("type: 4, local: 0, shared: 0, gpr: 12, inst: 77, loops: 1, bytes: 616"), "type: 4 = 77");
}

TEST(InstructionCount, amd_reports_no_count) {
    EXPECT_EQ(
        read("Shader Stats: SGPRS: 16 VGPRS: 8 Code Size: 212 LDS: 0 Scratch: 0 Max Waves: 10 (PS, W64)"),
        "nothing");
}

TEST(InstructionCount, other_lines_have_no_count) {
    for (const char* line :
         {"", ": 5 inst", "5 inst", "shader: inst", "shader: -5 inst, 0 loops", "shader: 5.5 inst",
          "shader: x5 inst", "shader: 5 instances", "shader: 5 instruction groups",
          "shader: 99999999999999999999 inst, 0 loops", "0:14(5): warning: 3 inst, not used",
          "type: 4, inst: many", "type: 4, inst: ", ",,,,"})
        EXPECT_EQ(read(line), "nothing") << line;
}

} // namespace tidemark::glsl::instruction_count_test
