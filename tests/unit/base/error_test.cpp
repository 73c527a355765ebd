#include "base/error.hpp"

#include <gtest/gtest.h>

namespace tidemark::error_test {

TEST(Diagnostic, prints_in_the_form_that_editors_parse) {
    EXPECT_EQ(to_string(Diagnostic{{"a.glsl", 12, 5}, Severity::error, "no"}), "a.glsl:12:5: error: no");
    EXPECT_EQ(to_string(Diagnostic{{"a.glsl", 12, 0}, Severity::warning, "no"}), "a.glsl:12: warning: no");
    EXPECT_EQ(to_string(Diagnostic{{"a.glsl", 0, 0}, Severity::note, "no"}), "a.glsl: note: no");
    EXPECT_EQ(to_string(Diagnostic{{}, Severity::error, "no"}), "error: no");
}

TEST(Diagnostic, a_column_without_a_line_is_left_out) {
    EXPECT_EQ(to_string(Diagnostic{{"a.glsl", 0, 5}, Severity::error, "no"}), "a.glsl: error: no");
}

TEST(Error, message_precedes_its_diagnostics) {
    const Error error{
        ErrorCode::load,
        "it does not compile",
        {{{"a.glsl", 3, 0}, Severity::error, "what"}, {{"b.glsl", 4, 0}, Severity::note, "why"}}};
    EXPECT_EQ(to_string(error), "tidemark: error: it does not compile\n"
                                "a.glsl:3: error: what\n"
                                "b.glsl:4: note: why");
}

TEST(Error, without_a_message_prints_only_diagnostics) {
    EXPECT_EQ(to_string(error_at({"a.glsl", 3, 0}, "what")), "a.glsl:3: error: what");
    EXPECT_EQ(to_string(Error{ErrorCode::usage, "what", {}}), "tidemark: error: what");
    EXPECT_EQ(to_string(Error{}), "");
}

TEST(Error, error_at_is_a_load_error_by_default) {
    EXPECT_EQ(error_at({}, "").code, ErrorCode::load);
    EXPECT_EQ(error_at({}, "", ErrorCode::write).code, ErrorCode::write);
    const Result<int> failed = fail(ErrorCode::usage, "what");
    EXPECT_EQ(failed.error().code, ErrorCode::usage);
    EXPECT_EQ(failed.error().message, "what");
}

TEST(ExitCode, codes_are_the_documented_numbers) {
    EXPECT_EQ(exit_code(ErrorCode::check_failed), 1);
    EXPECT_EQ(exit_code(ErrorCode::usage), 2);
    EXPECT_EQ(exit_code(ErrorCode::load), 3);
    EXPECT_EQ(exit_code(ErrorCode::write), 4);
    EXPECT_EQ(exit_code(ErrorCode::timed_out), 5);
    EXPECT_EQ(exit_code(ErrorCode::no_context), 77);
}

TEST(NearestName, corrects_typing_errors) {
    const std::vector<std::string> names{"wave_height", "wave_speed", "fog"};
    EXPECT_EQ(nearest_name("wave_hieght", names), "wave_height");
    EXPECT_EQ(nearest_name("waveheight", names), "wave_height");
    EXPECT_EQ(nearest_name("--siez", {"--set", "--size"}), "--size"); // two swapped letters are one mistake
    EXPECT_EQ(nearest_name("WAVE_speed", names), "");                 // four of ten letters differ
    EXPECT_EQ(nearest_name("fgo", names), "fog");                     // two swapped letters are one mistake
    EXPECT_EQ(nearest_name("gof", names), "");                        // two of three letters differ
    EXPECT_EQ(nearest_name("fo", names), "fog");
    EXPECT_EQ(nearest_name("fogg", names), "fog");
}

TEST(NearestName, prefers_the_nearer_and_then_the_first) {
    EXPECT_EQ(nearest_name("abcdef", {"abcdxx", "abcdex", "abcdey"}), "abcdex");
}

TEST(NearestName, empty_names_and_lists_give_no_suggestion) {
    EXPECT_EQ(nearest_name("a", {}), "");
    EXPECT_EQ(nearest_name("", {"scale"}), "");
}

} // namespace tidemark::error_test
