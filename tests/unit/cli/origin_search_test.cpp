// The window's messages about a trace that another process made.
#include "window/inspection.hpp"

#include <gtest/gtest.h>

namespace tidemark::window::origin_search_test {

TEST(OriginSearch, names_the_operation_to_fix) {
    const Error found =
        origin_of(R"json({"ended": "", "trace": {"first": {"file": "a.glsl", "line": 2}, "fix": {
        "file": "a.glsl", "line": 4, "column": 15, "statement": "c.g = sqrt(x)", "value": "NaN",
        "reason": "sqrt of a negative number"}}})json");
    EXPECT_EQ(to_string(found), "a.glsl:4:15: error: `c.g = sqrt(x)` gave NaN: sqrt of a negative number");
}

TEST(OriginSearch, distinguishes_a_finite_pixel_from_a_failure) {
    EXPECT_EQ(origin_of(R"json({"ended": "", "trace": null})json").message,
              "no origin was found: drawn again, the pixel is finite");
    EXPECT_EQ(origin_of(R"json({"ended": "given up after 60 s", "trace": null})json").message,
              "no origin was found: given up after 60 s");
    for (const char* broken : {"", "{", "[]"})
        EXPECT_EQ(origin_of(broken).message, "the trace ended without a result: run check --trace to see why")
            << broken;
}

} // namespace tidemark::window::origin_search_test
