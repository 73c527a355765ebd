#include "ir_support.hpp"

#include <gmock/gmock.h>

#include <algorithm>

namespace tidemark::proof::source_names_test {

using Kind = Assignment::Kind;

/// Lines of `functions` count from 5, those of `main` from 7 where functions have one line.
Function named(const std::string& functions, const std::string& main) {
    auto function = compile(shader(functions, main), Names::keep);
    EXPECT_TRUE(function) << function.error().message;
    return function ? *std::move(function) : Function();
}

std::vector<Assignment> on_line(const Function& function, int line) {
    std::vector<Assignment> result;
    std::ranges::copy_if(function.names.assignments, std::back_inserter(result),
                         [&](const Assignment& each) { return each.line == line; });
    return result;
}

TEST(SourceNames, are_kept_only_on_request) {
    EXPECT_TRUE(compiled("", "float a = iTime;\ncolor = vec4(a);").names.assignments.empty());
    EXPECT_FALSE(named("", "float a = iTime;\ncolor = vec4(a);").names.assignments.empty());
}

TEST(SourceNames, a_vector_is_its_scalars) {
    const Function function = named("", "vec3 p = gl_FragCoord.xyz * iTime;\ncolor = vec4(p, 1.0);");
    const auto found = on_line(function, 7);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].name, "p");
    EXPECT_EQ(found[0].rows, 3u);
    ASSERT_EQ(found[0].values.size(), 3u);
    EXPECT_EQ(function.instructions[found[0].values[2]].op, Op::multiply);
}

TEST(SourceNames, a_matrix_has_rows) {
    const auto found = on_line(
        named("", "mat2 m = mat2(1.0, iTime, 2.0, 3.0);\ncolor = vec4(m * vec2(iTime), 0.0, 1.0);"), 7);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].values.size(), 4u);
    EXPECT_EQ(found[0].rows, 2u);
}

TEST(SourceNames, members_have_the_names_of_their_struct) {
    const auto found = on_line(named("struct Hit { float d; vec3 n; };",
                                     "Hit h = Hit(iTime, vec3(iTime * 2.0));\ncolor = vec4(h.n, h.d);"),
                               7);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].name, "h.d");
    EXPECT_EQ(found[1].name, "h.n");
    EXPECT_EQ(found[1].values.size(), 3u);
}

TEST(SourceNames, loop_carried_values_are_named_at_the_loop_head) {
    const Function function = named(
        "", "float t = 0.0;\nfor (int i = 0; i < int(iTime); ++i)\n    t += 0.1 * iTime;\ncolor = vec4(t);");
    const auto head = on_line(function, 8);
    const auto carried = [&](const std::string& name) {
        return std::ranges::any_of(head, [&](const Assignment& each) {
            return each.kind == Kind::carried && each.name == name &&
                   function.instructions[each.values[0]].op == Op::phi;
        });
    };
    EXPECT_TRUE(carried("t"));
    EXPECT_TRUE(carried("i"));
    const auto step = on_line(function, 9);
    ASSERT_EQ(step.size(), 1u);
    EXPECT_EQ(step[0].kind, Kind::computed);
}

TEST(SourceNames, an_element_has_its_index) {
    const auto found = on_line(
        named("", "float a[4];\na[int(iTime)] = 2.0 * iTime;\ncolor = vec4(a[int(gl_FragCoord.x)]);"), 8);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].kind, Kind::stored);
    EXPECT_EQ(found[0].name, "a");
    EXPECT_NE(found[0].offset, k_no_value);
    EXPECT_EQ(found[0].stride, 1u);
}

TEST(SourceNames, an_inlined_function_lists_its_callers) {
    const Function function = named("float half_of(float a) { float b = 0.5 * a; return b + 1.0; }",
                                    "float x = half_of(iTime);\nx += half_of(x);\ncolor = vec4(x);");
    std::vector<int> lines;
    for (const Assignment& each : on_line(function, 5)) {
        EXPECT_EQ(each.name, "b");
        const InlinedCall& call = function.names.calls[each.call];
        EXPECT_EQ(call.function, "half_of");
        EXPECT_EQ(function.names.calls[call.caller].function, "main");
        lines.push_back(call.line);
    }
    EXPECT_THAT(lines, testing::ElementsAre(7, 8));
}

} // namespace tidemark::proof::source_names_test
