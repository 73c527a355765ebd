// Held against a real shell: it must hand the word on as it was.
#include "base/encoding.hpp"
#include "support/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>

namespace tidemark::shell_word_test {

std::string through_a_shell(std::string_view word) {
    const TemporaryFolder folder; // /bin/sh is dash here and there, which has no $'…'
    save_in_place(folder / "script", "printf %s " + shell_word(word));
    FILE* const shell = ::popen(("bash '" + (folder / "script").string() + "'").c_str(), "r");
    std::array<char, 256> text{};
    const size_t count = std::fread(text.data(), 1, text.size(), shell);
    ::pclose(shell);
    return {text.data(), count};
}

TEST(ShellWord, a_shell_passes_the_original_text) {
    for (const std::string_view word :
         {"waves.glsl", "OCTAVES=12", "my waves.glsl", "it's",        "''", "$HOME",
          "`date`",     "a\"b",       "vec2(1, -2)",   "~",           "*",  "a\\b",
          "a;b&c|d",    "#ff0000",    "two\nlines",    "N=",          "é",  "\x1b[31m'it\\'s",
          "tab\t1",     "\xff\x80",   "\u0085\u202e7", "$(touch x)\r"})
        EXPECT_EQ(through_a_shell(word), word);
}

TEST(ShellWord, stays_plain_where_that_is_safe) {
    EXPECT_EQ(shell_word("shaders/waves.glsl"), "shaders/waves.glsl");
    EXPECT_EQ(shell_word("height=0.5"), "height=0.5");
    EXPECT_EQ(shell_word(""), "''");
}

TEST(ShellWord, terminal_control_characters_are_escaped) {
    EXPECT_EQ(shell_word("\x1b]0;a'b\\\a"), "$'\\033]0;a\\'b\\\\\\007'");
    EXPECT_EQ(shell_word("é\u202e\xff"), "$'é\\342\\200\\256\\377'");
}

} // namespace tidemark::shell_word_test
