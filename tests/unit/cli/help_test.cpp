#include "cli/help_topics.hpp"

#include <gmock/gmock.h>

namespace tidemark::cli::help_test {

using testing::ElementsAre;
using testing::Field;

TEST(HelpTopics, a_page_and_its_sections_by_their_titles) {
    constexpr std::string_view page = "# Command line\n\nAll.\n\n## Exit codes\n\nNone.\n\n## Keys\nS\n";
    const std::string_view pages[] = {page};
    const auto topics = topics_of(pages);
    EXPECT_THAT(topics, ElementsAre(Field(&Topic::name, "command-line"), Field(&Topic::name, "exit-codes"),
                                    Field(&Topic::name, "keys")));
    EXPECT_EQ(topics[0].markdown, page);
    EXPECT_EQ(topics[1].markdown, "## Exit codes\n\nNone.\n");
    EXPECT_EQ(topics[2].markdown, "## Keys\nS\n");
}

TEST(HelpTopics, that_contain_a_word_the_most_frequent_first) {
    constexpr std::string_view pages[] = {
        "# Check\n\nAll.\n\n## Times\n\nA NaN at 0 s.\n\n## Find a NaN\n\nThe nan's line.\n"};
    const auto found = mentions_of("nan", topics_of(pages));
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].topic, "find-a-nan"); // in the heading and the text
    EXPECT_EQ(found[0].line, "Find a NaN");
    EXPECT_EQ(found[1].topic, "times");
    EXPECT_EQ(found[1].line, "A NaN at 0 s.");
    EXPECT_THAT(mentions_of("keyz", topics_of(pages)), testing::IsEmpty());
}

TEST(HelpText, links_and_emphasis_are_their_words_alone) {
    EXPECT_EQ(plain_text("## Keys\n\n**Press** [S](keys.md), not `[PASS:]N`.\n"),
              "Keys\n\nPress S, not `[PASS:]N`.\n");
}

TEST(HelpText, pictures_and_comments_are_left_out) {
    EXPECT_EQ(plain_text("a\n![sea](sea.png)\n<!-- options -->\nb"), "a\nb\n");
}

TEST(HelpText, code_is_kept_as_it_is) {
    EXPECT_EQ(plain_text("```sh\n**a** [b](c) | d\n```\n"), "    **a** [b](c) | d\n");
}

TEST(HelpText, a_narrow_table_stands_in_columns) {
    EXPECT_EQ(plain_text("| key | does |\n|---|---|\n| `S` | saves |\n| `é` | half\\|full |\n| H | |\n"),
              "  key  does\n  `S`  saves\n  `é`  half|full\n  H\n");
}

TEST(PlainText, gives_rows_of_tables_and_lines_of_examples) {
    EXPECT_THAT(rows_of("a\n| key | [does](x.md) |\n|---|---|\n| `S` | saves |\n"),
                ElementsAre(ElementsAre("key", "does"), ElementsAre("`S`", "saves")));
    EXPECT_THAT(example_lines("```sh\none \\\n  more\ntwo\n```\nthree\n```\nfour\n```\n"),
                ElementsAre("one \\\n  more", "two"));
}

TEST(HelpText, the_cells_of_a_wide_table_stand_below_each_other) {
    const std::string wide(50, 'x');
    EXPECT_EQ(plain_text("| " + wide + " | b | c |\n\nd\n"), "  " + wide + "\n      b\n      c\n\nd\n");
}

} // namespace tidemark::cli::help_test
