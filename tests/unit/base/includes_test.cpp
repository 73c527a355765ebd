#include "base/file.hpp"
#include "base/mapped_text.hpp"

#include <gmock/gmock.h>

#include <map>

namespace tidemark::text::includes_test {

using testing::ElementsAre;
using Files = std::map<std::string, std::string>;

/// Expands "main.glsl" of files that are nowhere but here.
Result<ExpandedText> expand(const Files& files, const std::string& path = "main.glsl") {
    const auto read = [&](const std::filesystem::path& wanted) -> Result<std::string> {
        const auto found = files.find(wanted.string());
        if (found == files.end())
            return fail(ErrorCode::load, "cannot read '" + wanted.string() + "': no such file");
        return found->second;
    };
    return expand_includes(path, read, "/library");
}

/// Returns each line after the place where it was written, as `main.glsl:1|text`.
std::string listed(const Result<ExpandedText>& expanded) {
    if (!expanded)
        return to_string(expanded.error());
    std::string list;
    std::string_view rest = expanded->text.text();
    for (int line = 1; !rest.empty(); ++line) {
        const SourceLocation where = expanded->text.lines().locate(line);
        const size_t end = rest.find('\n');
        list += where.file + ":" + std::to_string(where.line) + "|" + std::string(rest.substr(0, end)) + "\n";
        rest.remove_prefix(end + 1);
    }
    return list;
}

TEST(Includes, a_text_without_includes_is_unchanged) {
    EXPECT_EQ(listed(expand({{"main.glsl", "a\nb"}})), "main.glsl:1|a\n"
                                                       "main.glsl:2|b\n");
    EXPECT_EQ(listed(expand({{"main.glsl", ""}})), "");
}

TEST(Includes, are_pasted_where_they_stand) {
    EXPECT_EQ(listed(expand({{"main.glsl", "a\n#include \"b.glsl\"\nc\n"}, {"b.glsl", "b1\nb2"}})),
              "main.glsl:1|a\n"
              "b.glsl:1|b1\n"
              "b.glsl:2|b2\n"
              "main.glsl:2|\n"
              "main.glsl:3|c\n");
}

TEST(Includes, text_beside_a_directive_stays) {
    EXPECT_EQ(listed(expand({{"main.glsl", "/* a */ # include 'b.glsl' // c\nd"}, {"b.glsl", "b"}})),
              "main.glsl:1|/* a */ \n"
              "b.glsl:1|b\n"
              "main.glsl:1| // c\n"
              "main.glsl:2|d\n");
}

TEST(Includes, are_relative_to_the_including_file) {
    const auto expanded = expand({{"scenes/main.glsl", "#include \"../lib/b.glsl\""},
                                  {"lib/b.glsl", "#include \"deep/c.glsl\""},
                                  {"lib/deep/c.glsl", "#include \"/abs/d.glsl\""},
                                  {"/abs/d.glsl", "d\n"}},
                                 "./scenes/main.glsl");
    EXPECT_EQ(listed(expanded), "/abs/d.glsl:1|d\n");
    ASSERT_TRUE(expanded);
    EXPECT_THAT(expanded->files,
                ElementsAre("scenes/main.glsl", "lib/b.glsl", "lib/deep/c.glsl", "/abs/d.glsl"));
}

TEST(Includes, the_same_file_twice_is_pasted_twice_and_listed_once) {
    const auto expanded =
        expand({{"main.glsl", "#include \"b.glsl\"\n#include \"./b.glsl\"\n"}, {"b.glsl", "b\n"}});
    EXPECT_EQ(listed(expanded), "b.glsl:1|b\n"
                                "main.glsl:1|\n"
                                "b.glsl:1|b\n"
                                "main.glsl:2|\n");
    ASSERT_TRUE(expanded);
    EXPECT_THAT(expanded->files, ElementsAre("main.glsl", "b.glsl"));
}

TEST(Includes, line_ends_and_byte_order_marks_of_any_system) {
    EXPECT_EQ(listed(expand({{"main.glsl", "\xEF\xBB\xBF#include \"b.glsl\"\r\na\rb"},
                             {"b.glsl", "\xEF\xBB\xBF"
                                        "b1\r\nb2\r\n"}})),
              "b.glsl:1|b1\n"
              "b.glsl:2|b2\n"
              "main.glsl:1|\n"
              "main.glsl:2|a\n"
              "main.glsl:3|b\n");
}

TEST(Includes, in_comments_are_not_followed) {
    EXPECT_EQ(listed(expand({{"main.glsl", "// #include \"no\"\n/*\n#include \"no\"\n*/"}})),
              "main.glsl:1|// #include \"no\"\n"
              "main.glsl:2|/*\n"
              "main.glsl:3|#include \"no\"\n"
              "main.glsl:4|*/\n");
}

TEST(Includes, in_angle_brackets_are_files_of_the_library) {
    const auto expanded = expand({{"scenes/main.glsl", "#include <tidemark/b.glsl> // b\nd\n"},
                                  {"/library/b.glsl", "b\n#include \"deep/c.glsl\""},
                                  {"/library/deep/c.glsl", "#include <tidemark/e.glsl>"},
                                  {"/library/e.glsl", "e\n"}},
                                 "scenes/main.glsl");
    EXPECT_EQ(listed(expanded), "/library/b.glsl:1|b\n"
                                "/library/e.glsl:1|e\n"
                                "scenes/main.glsl:1| // b\n"
                                "scenes/main.glsl:2|d\n");
    EXPECT_EQ(listed(expand({{"main.glsl", "#include <tidemark/no.glsl>"}})),
              "main.glsl:1: error: cannot read '/library/no.glsl': no such file");
}

TEST(Includes, other_forms_are_left_to_the_driver) {
    const std::string text = "#include <tidemark/no\n>\n#include NAME\na #include \"no\"\n#include\n#if 0\n"
                             "#include <other>\n#endif\n#";
    const auto expanded = expand({{"main.glsl", text}});
    ASSERT_TRUE(expanded);
    EXPECT_THAT(expanded->text.text(),
                testing::AllOf(testing::HasSubstr("#include <tidemark/no\n>\n#include NAME\n"),
                               testing::HasSubstr("#include <other>\n")));
}

TEST(Includes, in_angle_brackets_need_quotes) {
    EXPECT_EQ(listed(expand({{"main.glsl", "\n#include <a/b.glsl>"}})),
              "main.glsl:2: error: write the file's name in quotes: #include \"a/b.glsl\"");
}

TEST(Includes, pragma_once_pastes_a_file_once) {
    EXPECT_EQ(listed(expand({{"main.glsl", "#include \"b.glsl\"\n#include \"b.glsl\"\nend\n"},
                             {"b.glsl", "#pragma once\nb\n"}})),
              "b.glsl:1|#pragma once\n"
              "b.glsl:2|b\n"
              "main.glsl:1|\n"
              "main.glsl:2|\n"
              "main.glsl:3|end\n");
}

TEST(Includes, a_missing_file_is_named_with_its_include_chain) {
    EXPECT_EQ(listed(expand({{"main.glsl", "\n#include \"b.glsl\"\n"},
                             {"b.glsl", "\n\n#include \"lib/c.glsl\""},
                             {"lib/c.glsl", "#include \"no.glsl\""}})),
              "lib/c.glsl:1: error: cannot read 'lib/no.glsl': no such file\n"
              "b.glsl:3: note: included from here\n"
              "main.glsl:2: note: included from here");
}

TEST(Includes, a_failure_lists_every_file_read) {
    const auto expanded =
        expand({{"main.glsl", "#include \"b.glsl\"\n"}, {"b.glsl", "#include \"lib/no.glsl\""}});
    ASSERT_FALSE(expanded);
    EXPECT_THAT(expanded.error().files, ElementsAre("main.glsl", "b.glsl", "lib/no.glsl"));
}

TEST(Includes, a_missing_first_file_has_no_place) {
    EXPECT_EQ(listed(expand({})), "tidemark: error: cannot read 'main.glsl': no such file");
}

TEST(Includes, a_cycle_is_named_with_its_include_chain) {
    EXPECT_EQ(
        listed(expand({{"main.glsl", "\n#include \"b.glsl\"\n"}, {"b.glsl", "#include \"./main.glsl\""}})),
        "b.glsl:1: error: './main.glsl' includes itself\n"
        "main.glsl:2: note: included from here");
    EXPECT_EQ(listed(expand({{"main.glsl", "#include \"main.glsl\""}})),
              "main.glsl:1: error: 'main.glsl' includes itself");
}

TEST(Includes, a_missing_file_under_a_condition_is_left_to_the_driver) {
    for (const std::string condition : {"#if 0", "#ifdef A", "#ifndef A"})
        EXPECT_EQ(listed(expand({{"main.glsl", condition + "\n#include \"no\" // why\n#endif\n"}})),
                  "main.glsl:1|" + condition +
                      "\n"
                      "main.glsl:2|#include \"no\"\n"
                      "main.glsl:2| // why\n"
                      "main.glsl:3|#endif\n");
    EXPECT_EQ(listed(expand({{"main.glsl", "#if 0\n#endif\n#include \"no\""}})),
              "main.glsl:3: error: cannot read 'no': no such file");
    EXPECT_EQ(listed(expand({{"main.glsl", "#endif\n#if 0\n#include \"no\""}})),
              "main.glsl:1|#endif\n"
              "main.glsl:2|#if 0\n"
              "main.glsl:3|#include \"no\"\n");
}

TEST(Includes, an_existing_file_under_a_condition_is_pasted) {
    EXPECT_EQ(listed(expand({{"main.glsl", "#if 1\n#include \"b\"\n#endif"}, {"b", "b\n"}})),
              "main.glsl:1|#if 1\n"
              "b:1|b\n"
              "main.glsl:2|\n"
              "main.glsl:3|#endif\n");
    EXPECT_EQ(listed(expand({{"main.glsl", "#if 1\n#include \"b\"\n#endif"}, {"b", "#include \"no\""}})),
              "b:1: error: cannot read 'no': no such file\n"
              "main.glsl:2: note: included from here");
}

TEST(Includes, too_deep_nesting_is_refused) {
    Files files;
    for (int i = 0; i <= 101; ++i)
        files[i == 0 ? "main.glsl" : std::to_string(i)] = "#include \"" + std::to_string(i + 1) + "\"\n";
    const auto expanded = expand(files);
    ASSERT_FALSE(expanded);
    ASSERT_EQ(expanded.error().diagnostics.size(), 101u);
    EXPECT_EQ(to_string(expanded.error().diagnostics.front()),
              "100:1: error: includes are nested more than 100 deep");
    EXPECT_EQ(to_string(expanded.error().diagnostics.back()), "main.glsl:1: note: included from here");
    files["100"] = "end\n";
    EXPECT_TRUE(expand(files));
}

/// Forty small files would grow to a million million lines.
TEST(Includes, exponential_growth_is_stopped) {
    Files files{{"40", ""}};
    for (int i = 0; i < 40; ++i) {
        const std::string next = "#include \"" + std::to_string(i + 1) + "\"\n";
        files[i == 0 ? "main.glsl" : std::to_string(i)] = next + next;
    }
    const auto expanded = expand(files);
    ASSERT_FALSE(expanded);
    EXPECT_EQ(to_string(expanded.error().diagnostics.front()),
              "39:1: error: there are more than 10000 includes to follow");
}

TEST(Includes, too_large_sums_are_stopped) {
    const std::string quarter(k_largest_text / 4, '\n');
    const std::string next = "#include \"b\"\n";
    EXPECT_EQ(listed(expand({{"main.glsl", next + next + next + next}, {"b", quarter}})),
              "b: error: the includes add up to more than 16 MiB\n"
              "main.glsl:4: note: included from here");
    EXPECT_EQ(listed(expand({{"main.glsl", next + next + next + quarter}, {"b", quarter}})),
              "main.glsl: error: the includes add up to more than 16 MiB");
}

} // namespace tidemark::text::includes_test
