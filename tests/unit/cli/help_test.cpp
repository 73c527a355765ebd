#include "cli/help.hpp"

#include <gmock/gmock.h>

#include <regex>

namespace tidemark::cli::help_test {

using testing::ElementsAre;
using testing::Field;

TEST(HelpTopics, pages_and_sections_are_found_by_title) {
    constexpr std::string_view page = "# Command line\n\nAll.\n\n## Exit codes\n\nNone.\n\n## Keys\nS\n";
    const std::string_view pages[] = {page};
    const auto topics = topics_of(pages);
    EXPECT_THAT(topics, ElementsAre(Field(&Topic::name, "command-line"), Field(&Topic::name, "exit-codes"),
                                    Field(&Topic::name, "keys")));
    EXPECT_EQ(topics[0].markdown, page);
    EXPECT_EQ(topics[1].markdown, "## Exit codes\n\nNone.\n");
    EXPECT_EQ(topics[2].markdown, "## Keys\nS\n");
}

TEST(HelpTopics, mentions_of_a_word_are_sorted_by_frequency) {
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

TEST(HelpPages, every_section_is_plain_text_under_its_heading) {
    const std::regex markup(R"(\]\(|\n\|--|<!--|!\[|<img|\*\*)");
    int sections = 0;
    for (const Topic& topic : topics_of(help_pages())) {
        SCOPED_TRACE(topic.name);
        const std::string_view line = topic.markdown.substr(0, topic.markdown.find('\n'));
        const std::string text = plain_text(topic.markdown);
        EXPECT_THAT(text, testing::StartsWith(std::string(line.substr(line.find(' ') + 1)) + "\n"));
        EXPECT_FALSE(std::regex_search(text, markup));
        ++sections;
    }
    EXPECT_GT(sections, 100);
}

TEST(HelpText, links_and_emphasis_become_plain_words) {
    EXPECT_EQ(plain_text("## Keys\n\n**Press** [S](keys.md), not `[PASS:]N`.\n"),
              "Keys\n\nPress S, not `[PASS:]N`.\n");
}

TEST(HelpText, pictures_and_comments_are_left_out) {
    EXPECT_EQ(plain_text("a\n![sea](sea.png)\n<!-- options -->\nb"), "a\nb\n");
}

TEST(HelpText, code_is_unchanged) {
    EXPECT_EQ(plain_text("```sh\n**a** [b](c) | d\n```\n"), "    **a** [b](c) | d\n");
}

TEST(HelpText, a_narrow_table_has_columns) {
    EXPECT_EQ(plain_text("| key | does |\n|---|---|\n| `S` | saves |\n| `é` | half\\|full |\n| H | |\n"),
              "  key  does\n  `S`  saves\n  `é`  half|full\n  H\n");
}

TEST(PlainText, has_one_line_per_table_row_and_example) {
    EXPECT_THAT(rows_of("a\n| key | [does](x.md) |\n|---|---|\n| `S` | saves |\n"),
                ElementsAre(ElementsAre("key", "does"), ElementsAre("`S`", "saves")));
    EXPECT_THAT(example_lines("```sh\none \\\n  more\ntwo\n```\nthree\n```\nfour\n```\n"),
                ElementsAre("one \\\n  more", "two"));
}

TEST(HelpText, cells_of_a_wide_table_are_stacked) {
    const std::string wide(50, 'x');
    EXPECT_EQ(plain_text("| " + wide + " | b | c |\n\nd\n"), "  " + wide + "\n      b\n      c\n\nd\n");
}

} // namespace tidemark::cli::help_test
