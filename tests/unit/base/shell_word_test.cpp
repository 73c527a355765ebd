// Held against a real shell: it must hand the word on as it was.
#include "base/shell_word.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>

namespace tidemark {
namespace {

std::string through_a_shell(std::string_view word) {
    FILE* const shell = ::popen(("printf %s " + shell_word(word)).c_str(), "r");
    std::array<char, 256> text{};
    const size_t count = std::fread(text.data(), 1, text.size(), shell);
    ::pclose(shell);
    return {text.data(), count};
}

TEST(ShellWord, a_shell_hands_it_on_as_it_was) {
    for (const std::string_view word :
         {"waves.glsl", "OCTAVES=12", "my waves.glsl", "it's", "''", "$HOME", "`date`", "a\"b", "vec2(1, -2)",
          "~", "*", "a\\b", "a;b&c|d", "#ff0000", "two\nlines", "N=", "é"})
        EXPECT_EQ(through_a_shell(word), word);
}

TEST(ShellWord, stays_plain_where_that_is_safe) {
    EXPECT_EQ(shell_word("shaders/waves.glsl"), "shaders/waves.glsl");
    EXPECT_EQ(shell_word("height=0.5"), "height=0.5");
    EXPECT_EQ(shell_word(""), "''");
}

} // namespace
} // namespace tidemark
