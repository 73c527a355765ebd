// How many iterations loops may have by their heads, and the text that records how each of them ended. What
// it records on a device: tests/cli/study_truth_test.py.
#include "glsl_support.hpp"
#include "shader/loops.hpp"
#include "shader/tree_facts.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace tidemark::glsl::loop_ends_test {

using testing::HasSubstr;
using testing::Not;

double most(const std::string& text) {
    const auto read = parsed(text);
    return most_iterations(*read, find_facts(*read));
}

TEST(Iterations, add_up_over_nested_loops_and_calls) {
    EXPECT_EQ(most("void main() {}"), 0);
    EXPECT_EQ(most("void main() { for (int i = 0; i < 100; i++) {} for (int i = 0; i <= 9; ++i) {} }"), 110);
    EXPECT_EQ(most("void main() { for (int i = 0; i < 300; i++) for (int j = 0; j < 300; j++) {} }"),
              300 * 301);
    EXPECT_EQ(most("float f() { float x = 0.0; for (int i = 0; i < 5; i++) x += 1.0; return x; }\n"
                   "float unused() { for (int i = 0; i < 900; i++) {} return 0.0; }\n"
                   "void main() { for (int i = 0; i < 10; i++) { f(); f(); } }"),
              10 * (1 + 2 * 5));
}

TEST(Iterations, are_unknown_without_a_count) {
    EXPECT_TRUE(std::isinf(most("uniform int n; void main() { for (int i = 0; i < n; i++) {} }")));
    EXPECT_TRUE(std::isinf(most("void main() { float t = 0.0; while (t < 1.0) t += 0.1 * t; }")));
}

std::string recorded(const std::string& text) {
    const auto read = parsed(text);
    return record_loop_ends(*read, find_facts(*read)).text;
}

TEST(LoopEnds, record_loops_ended_by_their_count) {
    const std::string text =
        recorded("void main() { for (int i = 0; i < 9; i++) { float d = 1.0; if (d < 0.1) break; } }");
    EXPECT_EQ(count(text, "counts(0,i < 9)"), 1) << text;
    EXPECT_EQ(count(text, "open[0]=false;break ;"), 1) << text;
    const std::string inside = recorded("void main() { int n = 3; while (true) { if (++n > 7) break; } }");
    EXPECT_EQ(count(inside, "counts(0,false);break ;"), 1) << inside;
    EXPECT_THAT(recorded("void main() { float t = 0.0; while (t < 9.0) t += 0.5 * t; }"),
                Not(HasSubstr("counts(0,t")));
}

TEST(LoopEnds, belong_to_the_innermost_loop_that_is_left) {
    const auto read = parsed("void main() { for (int i = 0; i < 3; i++) { switch (i) { case 0: break; } "
                             "for (int j = 0; j < 4; j++) break; } }");
    const LoopEnds ends = record_loop_ends(*read, find_facts(*read));
    ASSERT_EQ(ends.loops.size(), 2U);
    EXPECT_EQ(ends.words(), 4U);
    EXPECT_EQ(count(ends.text, "=false;break ;"), 1) << ends.text;
    EXPECT_EQ(recorded("void main() {}"), "");
}

} // namespace tidemark::glsl::loop_ends_test
