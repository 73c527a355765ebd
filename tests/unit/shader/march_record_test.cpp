// The places of a text in which a march is recorded, and texts that are refused. The pictures and reports of
// the changed text are tested on the device, in tests/gl/recorded_hits_gl_test.cpp.
#include "glsl_support.hpp"
#include "shader/march_record.hpp"

#include <gtest/gtest.h>

namespace tidemark::glsl::march_record_test {

constexpr const char* k_file = "a.glsl";

/// The lines of a march whose test stands in line 4 of the text, and whose step in line 5.
MarchLines lines(size_t comparisons = 1, size_t which = 0) {
    MarchLines lines;
    lines.test = {k_file, 4, 0};
    lines.comparisons = comparisons;
    lines.which = which;
    lines.updates = {{k_file, 5, 0}};
    return lines;
}

std::string text_of(const std::string& head, const std::string& test, const std::string& step) {
    return "void mainImage(out vec4 c, in vec2 p) {\n    float t = 0.0, d = 1.0;\n    " + head + "\n" + test +
           "\n" + step + "\n    c = vec4(t); }\n";
}

struct Found {
    std::unique_ptr<const ParsedText> text;
    Result<MarchNodes> march;
    Result<text::MappedText> record;
};

Found found(const std::string& glsl, const MarchLines& lines) {
    text::MappedText source;
    source.append(glsl, k_file, 1);
    auto parsed = ParsedText::read(std::move(source), k_site_macros);
    EXPECT_TRUE(parsed);
    const TreeFacts facts = find_facts(**parsed);
    auto march = find_march(**parsed, facts, lines);
    auto record = record_marches(**parsed, facts, std::span(&lines, 1));
    return {*std::move(parsed), std::move(march), std::move(record)};
}

std::string refusal(const std::string& glsl, const MarchLines& lines) {
    const Found of = found(glsl, lines);
    EXPECT_FALSE(of.record);
    return of.record ? std::string() : of.record.error().message;
}

const std::string k_for = "for (int i = 0; i < 9; ++i) { d = length(p) - t;";

TEST(MarchRecord, finds_test_place_and_limit) {
    const Found of = found(text_of(k_for, "if (d < 0.001 || t > 9.0) break;", "t += d; }"), lines(2));
    ASSERT_TRUE(of.march) << of.march.error().message;
    EXPECT_EQ(of.text->excerpt(of.march->test), "d < 0.001");
    EXPECT_EQ(of.text->excerpt(of.march->distance), "d");
    EXPECT_EQ(of.march->place, "t ");
    ASSERT_EQ(of.march->limits.size(), 1u);
    EXPECT_EQ(of.text->excerpt(of.march->limits[0].test), "i < 9");
    EXPECT_FALSE(of.march->limits[0].stopping);
    ASSERT_TRUE(of.record) << of.record.error().message;
    EXPECT_EQ(count(of.record->text(), "tmw0_tested(tmw0_on,"), 1);
    EXPECT_EQ(count(of.record->text(), "tmw0_bound(tmw0_on,i < 9,false)"), 1);
    EXPECT_EQ(of.record->lines().locate(line_of(*of.record, "break;")).line, 4); // no line moves
}

TEST(MarchRecord, selects_the_comparison_of_the_distance) {
    const Found of = found(text_of(k_for, "if (t > 9.0 || 0.001 > d) break;", "t += d; }"), lines(2, 1));
    ASSERT_TRUE(of.march);
    EXPECT_EQ(of.text->excerpt(of.march->distance), "d");
    EXPECT_EQ(of.text->excerpt(of.march->threshold), "0.001");
}

TEST(MarchRecord, finds_a_limit_in_a_separate_condition) {
    const Found of = found(text_of("int n = 0; while (true) { if (n++ > 50) break; d = length(p) - t;",
                                   "if (d < 0.001) break;", "t = min(t + 0.7 * d, 9.0); }"),
                           lines());
    ASSERT_TRUE(of.march) << of.march.error().message;
    EXPECT_EQ(of.march->place, "t ");
    ASSERT_EQ(of.march->limits.size(), 1u);
    EXPECT_EQ(of.text->excerpt(of.march->limits[0].test), "n++ > 50");
    EXPECT_TRUE(of.march->limits[0].stopping);
}

TEST(MarchRecord, refuses_ambiguous_marches) {
    const std::string test = "if (d < 0.001 || t > 9.0) break;", step = "t += d; }";
    EXPECT_EQ(refusal(text_of(k_for, test, step), lines(1)),
              "a.glsl:4: it is not certain which comparison tests the distance");
    EXPECT_EQ(refusal(text_of(k_for, "if (near(d)) break;", step), lines(1)),
              "a.glsl:4: the test of the distance is not in its loop");
    EXPECT_EQ(refusal(text_of(k_for, test, "go(t, d); }"), lines(2)),
              "a.glsl:4: it is not certain what the march moves along its ray");
    EXPECT_EQ(refusal(text_of(k_for, test, "t += d; p += d; }"), lines(2)),
              "a.glsl:4: the march moves more than one variable along its ray");
    EXPECT_EQ(
        refusal(text_of("int n = 9; for (int i = 0; i < n; ++i) { d = length(p) - t; n = 9;", test, step),
                lines(2)),
        "a.glsl:4: the limit of the march's number of steps is not found");
    EXPECT_EQ(refusal("#define NEAR d < 0.001\nvoid mainImage(out vec4 c, in vec2 p) { float t = 0.0, d;\n" +
                          k_for + "\nif (NEAR) break;\n" + step + " c = vec4(t); }\n",
                      lines()),
              "a.glsl:4: the march is in a macro");
    EXPECT_EQ(refusal(text_of(k_for + " if (p.x > 9.0) discard;", test, step), lines(2)),
              "the text discards pixels");
}

} // namespace tidemark::glsl::march_record_test
