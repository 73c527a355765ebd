#include "render/frame_plan.hpp"

#include <gmock/gmock.h>

namespace tidemark::render {
namespace {

using testing::ElementsAre;

gl::Reflection with(const std::vector<std::string>& names) {
    gl::Reflection reflection;
    for (const std::string& name : names)
        reflection.uniforms.push_back({name});
    return reflection;
}

TEST(PlanFrame, a_pass_reads_what_its_program_kept) {
    scene::Scene scene;
    scene.passes.resize(1);
    const FramePlan plan = plan_frame(scene, {with({"iTime", "iChannel3", "iChannel0", "iChannelTime"})});
    ASSERT_EQ(plan.passes.size(), 1u);
    EXPECT_EQ(plan.passes[0].pass, 0u);
    EXPECT_THAT(plan.passes[0].channels, ElementsAre(0, 3));
}

TEST(PlanFrame, a_program_without_channels_reads_none) {
    scene::Scene scene;
    scene.passes.resize(1);
    EXPECT_THAT(plan_frame(scene, {with({"iChannel4", "iChannelResolution"})}).passes[0].channels,
                ElementsAre());
}

TEST(PlanFrame, passes_are_drawn_in_the_scene_s_order) {
    scene::Scene scene;
    scene.passes.resize(3);
    const FramePlan plan = plan_frame(scene, {with({"iChannel0"}), with({}), with({"iChannel1"})});
    ASSERT_EQ(plan.passes.size(), 3u);
    for (size_t i = 0; i < 3; ++i)
        EXPECT_EQ(plan.passes[i].pass, i);
    EXPECT_THAT(plan.passes[2].channels, ElementsAre(1));
}

} // namespace
} // namespace tidemark::render
