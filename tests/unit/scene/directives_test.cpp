// Places where directives are found, and the text that is left.
#include "directives_support.hpp"
#include "support/naming.hpp"

#include <gtest/gtest.h>

namespace tidemark::scene::directives_test {

std::string rest(std::string_view text) {
    text::MappedText mapped;
    mapped.append(text, "a.glsl", 1);
    const auto taken = take_directives(mapped);
    return taken ? mapped.text() : to_string(taken.error());
}

TEST(Directives, are_blanked_out_and_move_no_line) {
    EXPECT_EQ(rest("a\n#iChannel0 \"noise\" // why\nb\n#iUniform float c\n= 1.0\nd;"),
              "a\n // why\nb\n\n\nd;\n");
    EXPECT_EQ(rest("#iUniform float a = 1.0 #iUniform float b = 2.0 c"), "  c\n");
    EXPECT_EQ(rest("#iUniform float a = 1.0"), "\n");
}

TEST(Directives, in_comments_are_ignored) {
    const std::string text = "// #iUniform bool a\n/* #iKeyboard */\n";
    EXPECT_EQ(rest(text), text);
}

TEST(Directives, of_the_preprocessor_are_unchanged) {
    const std::string text = "#define A 1\n#if A\n#endif\n# iUniform bool a\n#pragma x\n#";
    EXPECT_EQ(rest(text), text + "\n");
}

TEST(Directives, strict_compatibility_is_accepted_and_removed) {
    EXPECT_EQ(rest("#StrictCompatibility\na"), "\na\n");
}

TEST(Directives, unsupported_directives_are_removed_with_a_warning) {
    const auto directives = read("#iVertex \"default\"\n#iVertex \"a.glsl\"\n#iFirstPersonControls\n");
    ASSERT_TRUE(directives);
    EXPECT_TRUE(directives->moves_view);
    ASSERT_EQ(directives->warnings.size(), 2u);
    EXPECT_THAT(to_string(directives->warnings[0]), naming("dir/a.glsl:2: warning: #iVertex is ignored:"));
    EXPECT_THAT(to_string(directives->warnings[1]), naming("dir/a.glsl:3: warning: #iFirstPersonControls:"));
    EXPECT_THAT(refusal("#iVertex 1"), naming("dir/a.glsl:1:10: error:", "name in quotes", "'1'"));
}

TEST(Directives, keyboard_requests_the_helpers) {
    EXPECT_FALSE(read("a;")->keyboard_helpers);
    EXPECT_TRUE(read("a;\n#iKeyboard")->keyboard_helpers);
    EXPECT_EQ(rest("#iKeyboard\na"), "\na\n");
}

TEST(Directives, a_size_is_two_numbers_of_pixels) {
    const auto directives = read("a;\n#iSize 800x450 // wide\nb;");
    ASSERT_TRUE(directives);
    ASSERT_EQ(directives->sizes.size(), 1u);
    EXPECT_EQ(directives->sizes[0].extent, (Extent{800, 450}));
    EXPECT_EQ(directives->sizes[0].where.line, 2);
    EXPECT_EQ(rest("#iSize 800x450 // wide\nb;"), " // wide\nb;\n");
    EXPECT_EQ(read("#iSize 32767x1")->sizes.at(0).extent, (Extent{32767, 1}));
    EXPECT_TRUE(read("a;")->sizes.empty());
}

TEST(Directives, an_invalid_size_is_refused_at_its_place) {
    for (const std::string text : {"800", "800x", "x450", "0x450", "800x450x2", "800x-1", "32768x1", "1.5x2",
                                   "0x10x20", "800x450#iKeyboard"})
        EXPECT_EQ(
            refusal("a;\n#iSize " + text),
            "dir/a.glsl:2:8: error: '" + text +
                "' is not a size: give WIDTHxHEIGHT in pixels, each from 1 to 32767, as in #iSize 800x450");
    EXPECT_THAT(refusal("#iSize\n800x450"),
                naming("dir/a.glsl:1:7: error:", "a size", "800x450", "the end of the line"));
}

TEST(Directives, under_an_if_are_ignored_in_a_shadertoy_text) {
    text::MappedText mapped;
    const std::string text = "#ifdef VSCODE\n#iChannel0 \"x.png\"\n#endif\n#iChannel1 \"y.png\"\n";
    mapped.append(text, "dir/a.glsl", 1);
    const auto directives = take_directives(mapped, Conditional::leave);
    ASSERT_TRUE(directives);
    EXPECT_EQ(directives->sources[0], "");
    EXPECT_EQ(directives->sources[1], "y.png");
    EXPECT_EQ(mapped.text(), "#ifdef VSCODE\n#iChannel0 \"x.png\"\n#endif\n\n");
}

TEST(Directives, of_an_included_file_have_its_place) {
    text::MappedText mapped;
    mapped.append("a;", "scenes/main.glsl", 1);
    mapped.append("\n#iChannel0 \"t.png\"\n#iUniform float k = 1.0\n", "lib/b.glsl", 5);
    mapped.append("#iUniform int k = 1", "scenes/main.glsl", 3);
    const auto directives = take_directives(mapped);
    ASSERT_FALSE(directives);
    EXPECT_EQ(to_string(directives.error()), "scenes/main.glsl:3: error: the knob 'k' is declared twice\n"
                                             "lib/b.glsl:7: note: first declared here");
    text::MappedText good;
    good.append("a;", "scenes/main.glsl", 1);
    good.append("\n#iChannel0 \"t.png\"", "lib/b.glsl", 5);
    const auto read = take_directives(good);
    ASSERT_TRUE(read);
    EXPECT_EQ(read->channels[0].input, ChannelInput(Picture{"lib/t.png"}));
    EXPECT_EQ(read->channels[0].where, (SourceLocation{"lib/b.glsl", 6, 0}));
}

} // namespace tidemark::scene::directives_test
