#include "base/mapped_text.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace tidemark::text::mapped_text_test {

std::string at(const LineMap& lines, int line) {
    const SourceLocation where = lines.locate(line);
    return where.file + ":" + std::to_string(where.line);
}

TEST(LineMap, a_run_lasts_until_the_next) {
    LineMap lines;
    lines.begin_run(1, "a", 10);
    lines.begin_run(4, "b", 1);
    lines.begin_run(5, "a", 13);
    EXPECT_EQ(at(lines, 1), "a:10");
    EXPECT_EQ(at(lines, 3), "a:12");
    EXPECT_EQ(at(lines, 4), "b:1");
    EXPECT_EQ(at(lines, 5), "a:13");
    EXPECT_EQ(at(lines, 100), "a:108");
}

TEST(LineMap, the_last_of_two_runs_on_a_line_counts) {
    LineMap lines;
    lines.begin_run(1, "a", 1);
    lines.begin_run(1, "b", 7);
    EXPECT_EQ(at(lines, 1), "b:7");
}

TEST(LineMap, columns_are_passed_on) {
    LineMap lines;
    lines.begin_run(1, "a", 10);
    EXPECT_EQ(lines.locate(2, 5), (SourceLocation{"a", 11, 5}));
}

TEST(LineMap, generated_lines_have_no_place) {
    EXPECT_EQ(LineMap().locate(1), SourceLocation{});
    LineMap lines;
    lines.begin_run(3, "a", 1);
    lines.begin_run(5, "", 0);
    for (const int line : {std::numeric_limits<int>::min(), -1, 0, 2, 5, 6})
        EXPECT_EQ(lines.locate(line, 4), SourceLocation{}) << line;
}

TEST(LineMap, a_line_number_out_of_range_has_no_place) {
    LineMap lines;
    lines.begin_run(1, "a", 10);
    EXPECT_EQ(lines.locate(std::numeric_limits<int>::max()), SourceLocation{});
}

TEST(MappedText, every_chunk_starts_a_line) {
    MappedText text;
    text.append("one\ntwo", "a", 1);
    text.append_generated("three");
    text.append("", "nothing", 1);
    text.append("four\n", "b", 7);
    EXPECT_EQ(text.text(), "one\ntwo\nthree\nfour\n");
    EXPECT_EQ(text.line_count(), 4);
    EXPECT_EQ(at(text.lines(), 2), "a:2");
    EXPECT_EQ(at(text.lines(), 3), ":0");
    EXPECT_EQ(at(text.lines(), 4), "b:7");
}

TEST(MappedText, empty_has_no_lines) {
    const MappedText text;
    EXPECT_EQ(text.text(), "");
    EXPECT_EQ(text.line_count(), 0);
    EXPECT_EQ(at(text.lines(), 1), ":0");
}

TEST(MappedText, appending_another_keeps_its_places) {
    MappedText inner;
    inner.append("i1\ni2\n", "inner", 5);
    inner.append_generated("made\n");
    MappedText text;
    text.append_generated("prologue\n");
    text.append(inner);
    text.append("o\n", "outer", 2);
    EXPECT_EQ(text.text(), "prologue\ni1\ni2\nmade\no\n");
    EXPECT_EQ(text.line_count(), 5);
    EXPECT_EQ(at(text.lines(), 1), ":0");
    EXPECT_EQ(at(text.lines(), 2), "inner:5");
    EXPECT_EQ(at(text.lines(), 3), "inner:6");
    EXPECT_EQ(at(text.lines(), 4), ":0");
    EXPECT_EQ(at(text.lines(), 5), "outer:2");
}

TEST(MappedText, edits_replace_the_text_they_cover) {
    MappedText text;
    text.append("0123456789", "a", 1);
    text.apply({{0, 1, "X"}, {3, 3, "-"}, {4, 6, ""}, {9, 10, "end"}});
    EXPECT_EQ(text.text(), "X12-3678end\n");
    text.apply({});
    EXPECT_EQ(text.text(), "X12-3678end\n");
}

TEST(MappedText, edits_move_no_line) {
    MappedText text;
    text.append("a = (1 +\n2 +\n3);\nb\n", "a", 1);
    text.apply({{4, 15, "x"}});
    EXPECT_EQ(text.text(), "a = x\n\n;\nb\n");
    EXPECT_EQ(text.line_count(), 4);
    EXPECT_EQ(at(text.lines(), 4), "a:4");
}

TEST(MappedText, a_token_that_a_line_end_splits_is_joined) {
    MappedText text;
    text.append("#def\\\n\\\nine A \\\n 1\na +\\\n= 2; /\\\n/ c\nd \\\n e;\\\nf\n", "a", 1);
    EXPECT_EQ(text.text(), "#define A  1\n\n\n\na += 2; // c\n\n\nd \\\n e;\\\nf\n");
    EXPECT_EQ(at(text.lines(), 5), "a:5");
    EXPECT_EQ(at(text.lines(), 10), "a:10");
    text.append("x\\\ny", "b", 1);
    EXPECT_EQ(at(text.lines(), 12), "b:2");
    EXPECT_THAT(text.text(), testing::EndsWith("f\nxy\n\n"));
    text.append("g\\", "c", 1); // the last line of a file
    text.append("h", "c", 2);
    EXPECT_THAT(text.text(), testing::EndsWith("g\\\nh\n"));
}

TEST(PlainLineEnds, line_ends_of_every_system_become_newlines) {
    EXPECT_EQ(with_plain_line_ends("a\r\nb\rc\nd\n\re\r\r\nf\r"), "a\nb\nc\nd\n\ne\n\nf\n");
    EXPECT_EQ(with_plain_line_ends(""), "");
    EXPECT_EQ(with_plain_line_ends("\r\n"), "\n");
}

TEST(PlainLineEnds, only_a_leading_byte_order_mark_goes) {
    EXPECT_EQ(with_plain_line_ends("\xEF\xBB\xBF#define A"), "#define A");
    EXPECT_EQ(with_plain_line_ends("a\xEF\xBB\xBF"), "a\xEF\xBB\xBF");
    EXPECT_EQ(with_plain_line_ends("\xEF\xBB"), "\xEF\xBB");
}

TEST(MappedText, columns_are_the_authors_after_edits) {
    MappedText text;
    text.append("out a; float b, c; d\nnext line\n", "a.glsl", 1);
    text.apply({{0, 3, "inout"}, {14, 14, "=0"}, {17, 17, "=0"}});
    ASSERT_EQ(text.text(), "inout a; float b=0, c=0; d\nnext line\n");
    const auto column = [&](std::string_view piece) {
        const size_t at = text.text().find(piece);
        return text.lines().locate(1, int(at) + 1).column;
    };
    EXPECT_EQ(column("inout"), 1);
    EXPECT_EQ(column("a;"), 5);
    EXPECT_EQ(column(", c"), 15);
    EXPECT_EQ(column("d\n"), 20);
    EXPECT_EQ(text.lines().locate(2, 6).column, 6);
    text.apply({{0, 6, ""}, {9, 14, "vec2"}}); // what was edited before is edited again
    ASSERT_EQ(text.text(), "a; vec2 b=0, c=0; d\nnext line\n");
    EXPECT_EQ(column("a;"), 5);
    EXPECT_EQ(column("b=0"), 14);
    EXPECT_EQ(column(", c"), 15);
    EXPECT_EQ(column("d\n"), 20);
    MappedText whole;
    whole.append_generated("prologue\n");
    whole.append(text);
    EXPECT_EQ(whole.lines().locate(2, 9).column, 14);
}

TEST(MappedText, replaced_text_has_the_place_of_the_original) {
    MappedText text;
    text.append("a = old + b;\n  c = old + d;\n", "a.glsl", 1);
    text.apply({{4, 7, "f(x, y)"}, {17, 17, "1 * "}, {19, 22, "long_name"}});
    const auto column = [&](int line, std::string_view piece) {
        const size_t begin = line == 1 ? 0 : text.text().find('\n') + 1;
        return text.lines().locate(line, int(text.text().find(piece, begin) - begin) + 1).column;
    };
    for (const std::string_view piece : {"f(", "(x", "x,", "y)", ") +"})
        EXPECT_EQ(column(1, piece), 5) << piece;
    EXPECT_EQ(column(1, "+ b"), 9);
    EXPECT_EQ(column(2, "1 *"), 5);
    EXPECT_EQ(column(2, "* = "), 5);
    EXPECT_EQ(column(2, "= long"), 5);
    EXPECT_EQ(column(2, "long"), 7);
    EXPECT_EQ(column(2, "+ d"), 11);
    text.apply({{0, 1, "ab"}, {6, 7, "xx"}});
    EXPECT_EQ(column(1, "xx"), 5);
    EXPECT_EQ(column(1, "y)"), 5);
    EXPECT_EQ(column(1, "+ b"), 9);
}

TEST(MappedText, columns_after_an_edit_over_lines) {
    MappedText text;
    text.append("a /*\n*/ b\n", "a.glsl", 1);
    text.apply({{2, 7, " "}});
    ASSERT_EQ(text.text(), "a  \n b\n");
    EXPECT_EQ(text.lines().locate(2, 2).column, 4);
}

} // namespace tidemark::text::mapped_text_test
