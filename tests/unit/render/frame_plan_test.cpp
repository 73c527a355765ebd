#include "render/frame_plan.hpp"

#include <gmock/gmock.h>

#include <optional>

namespace tidemark::render::frame_plan_test {

using testing::ElementsAre;

gl::Reflection with(const std::vector<std::string>& names) {
    gl::Reflection reflection;
    for (const std::string& name : names)
        reflection.uniforms.push_back({name});
    return reflection;
}

using Reflections = std::vector<std::optional<gl::Reflection>>;

scene::Channel reads(size_t pass) {
    scene::Channel channel;
    channel.input = scene::PassOutput{pass};
    return channel;
}

/// Passes whose channels are all unbound; the last is Image.
scene::Scene scene_of(size_t passes) {
    scene::Scene scene;
    scene.passes.resize(passes);
    for (scene::Pass& pass : scene.passes) {
        pass.kind = scene::PassKind::buffer;
        for (scene::Channel& channel : pass.channels)
            channel.input = scene::Unbound{};
    }
    scene.passes.back().kind = scene::PassKind::image;
    return scene;
}

TEST(PlanFrame, a_pass_reads_the_active_channels_of_its_program) {
    scene::Scene scene = scene_of(1);
    const FramePlan plan = plan_frame(
        scene, Reflections{with({"iTime", "iChannel9", "iChannel3", "iChannel0", "iChannelTime"})}, 0);
    ASSERT_EQ(plan.passes.size(), 1u);
    EXPECT_EQ(plan.passes[0].pass, 0u);
    EXPECT_THAT(plan.passes[0].channels, ElementsAre(0, 3, 9));
    EXPECT_FALSE(plan.feedback);
}

TEST(PlanFrame, a_program_without_channels_reads_no_channel) {
    const FramePlan plan =
        plan_frame(scene_of(1), Reflections{with({"iChannel10", "iChannelResolution"})}, 0);
    EXPECT_THAT(plan.passes[0].channels, ElementsAre());
}

TEST(PlanFrame, a_read_resolution_needs_the_texture_of_its_channel) {
    scene::Scene scene = scene_of(2);
    scene.passes[1].channels[0] = reads(0);
    scene.passes[1].channels[1].input = scene::Noise{}; // by default, and stated in the text
    scene.passes[1].channels[2].input = scene::Noise{};
    scene.passes[1].channels[2].where = {"a.glsl", 1};
    for (const char* name : {"iChannelResolution", "iChannelTime"}) {
        gl::Reflection reflection = with({name});
        reflection.uniforms[0].length = 4;
        FramePlan plan = plan_frame(scene, Reflections{with({}), reflection}, 1);
        EXPECT_THAT(plan.passes.back().channels, ElementsAre(1, 2));
        EXPECT_EQ(plan.find(0), nullptr) << "the size of a buffer is that of the canvas";
        reflection.uniforms[0].length = 2; // the others are not asked for
        plan = plan_frame(scene, Reflections{with({}), reflection}, 1);
        EXPECT_THAT(plan.passes.back().channels, ElementsAre(1));
    }
    for (const char* name :
         {"iCh1.size", "iCh1.loaded", "iCh1.time", "iChannel[1].resolution", "iChannel[1].time"})
        EXPECT_THAT(plan_frame(scene, Reflections{with({}), with({name})}, 1).passes.back().channels,
                    ElementsAre(1))
            << name;
    EXPECT_THAT(plan_frame(scene, Reflections{with({}), with({"iCh0.size"})}, 1).passes.back().channels,
                ElementsAre());
}

TEST(PlanFrame, a_sampler_of_a_struct_reads_its_texture) {
    scene::Scene scene = scene_of(2);
    scene.passes[1].channels[0] = reads(0);
    const FramePlan plan =
        plan_frame(scene, Reflections{with({}), with({"iCh0.sampler", "iCh3.sampler"})}, 1);
    EXPECT_THAT(plan.passes.back().channels, ElementsAre(0, 3)) << "black where nothing is bound";
    EXPECT_NE(plan.find(0), nullptr);
}

/// On ShaderToy, too, a sampler that no host sets stays at unit 0.
TEST(PlanFrame, a_sampler_of_the_author_s_reads_channel_0) {
    scene::Scene scene = scene_of(2);
    scene.passes[1].channels[0] = reads(0);
    gl::Reflection reflection = with({"picture"});
    reflection.uniforms[0].type = GL_SAMPLER_2D;
    const FramePlan plan = plan_frame(scene, Reflections{with({}), reflection}, 1);
    EXPECT_THAT(plan.passes.back().channels, ElementsAre(0));
    EXPECT_NE(plan.find(0), nullptr);
    for (const char* const name : {"iKeyboard", "iChannel2", "iCh2.sampler"}) {
        reflection.uniforms[0].name = name;
        EXPECT_EQ(plan_frame(scene, Reflections{with({}), reflection}, 1).find(0), nullptr) << name;
    }
    reflection.uniforms[0] = {"picture", GL_FLOAT};
    EXPECT_EQ(plan_frame(scene, Reflections{with({}), reflection}, 1).find(0), nullptr);
}

TEST(PlanFrame, passes_are_drawn_in_the_scene_s_order) {
    scene::Scene scene = scene_of(3);
    scene.passes[2].channels[1] = reads(0);
    scene.passes[0].channels[0] = reads(1);
    const FramePlan plan =
        plan_frame(scene, Reflections{with({"iChannel0"}), with({}), with({"iChannel1"})}, 2);
    ASSERT_EQ(plan.passes.size(), 3u);
    for (size_t i = 0; i < 3; ++i)
        EXPECT_EQ(plan.passes[i].pass, i);
    EXPECT_THAT(plan.passes[2].channels, ElementsAre(1));
}

TEST(PlanFrame, an_unread_pass_is_not_drawn) {
    scene::Scene scene = scene_of(3);
    scene.passes[2].channels[0] = reads(0);
    scene.passes[2].channels[1] = reads(1); // but its program does not
    const FramePlan plan = plan_frame(scene, Reflections{with({}), with({}), with({"iChannel0"})}, 2);
    EXPECT_NE(plan.find(0), nullptr);
    EXPECT_EQ(plan.find(1), nullptr);
}

TEST(PlanFrame, only_a_pass_that_reads_itself_has_two_textures) {
    scene::Scene scene = scene_of(3);
    scene.passes[0].channels[0] = reads(0);
    scene.passes[0].channels[1] = reads(1); // last frame's, read before it is drawn over
    scene.passes[2].channels[0] = reads(0);
    const FramePlan plan =
        plan_frame(scene, Reflections{with({"iChannel0", "iChannel1"}), with({}), with({"iChannel0"})}, 2);
    EXPECT_TRUE(plan.targets[0].two_textures);
    EXPECT_FALSE(plan.targets[1].two_textures);
    EXPECT_TRUE(plan.feedback);
}

TEST(PlanFrame, a_buffer_has_mipmaps_if_a_reader_filters_with_mipmaps) {
    scene::Scene scene = scene_of(2);
    scene.passes[1].channels[0] = reads(0);
    scene.passes[1].channels[0].sampling.mipmaps = scene::Mipmaps::linear;
    EXPECT_TRUE(plan_frame(scene, Reflections{with({}), with({"iChannel0"})}, 1).targets[0].mipmaps);
    scene.passes[1].channels[0].sampling.mipmaps = scene::Mipmaps::none;
    EXPECT_FALSE(plan_frame(scene, Reflections{with({}), with({"iChannel0"})}, 1).targets[0].mipmaps);
}

TEST(FrameRef, earlier_passes_are_read_from_this_frame) {
    EXPECT_EQ(frame_ref(2, 1), FrameRef::current);
    EXPECT_EQ(frame_ref(1, 1), FrameRef::previous);
    EXPECT_EQ(frame_ref(1, 2), FrameRef::previous);
}

TEST(PlanFrame, an_extra_pass_is_drawn_without_readers) {
    const Reflections programs{with({}), with({})};
    EXPECT_EQ(plan_frame(scene_of(2), programs, 1).passes.size(), 1u);
    EXPECT_EQ(plan_frame(scene_of(2), programs, 1, {.passes = true}).passes.size(), 2u);
    EXPECT_EQ(plan_frame(scene_of(2), Reflections{std::nullopt, with({})}, 1, {.passes = true}).passes.size(),
              1u)
        << "one that did not link";
}

TEST(PlanFrame, extra_channels_have_a_texture_without_readers) {
    const FramePlan plan = plan_frame(scene_of(1), Reflections{with({})}, 0, {.channels = true});
    EXPECT_THAT(plan.passes[0].channels, ElementsAre(0, 1, 2, 3));
}

TEST(PlanFrame, extra_textures_and_mipmaps_are_those_of_buffers) {
    scene::Scene scene = scene_of(2);
    scene.passes[1].channels[0] = reads(0);
    const FramePlan plan = plan_frame(scene, Reflections{with({}), with({"iChannel0"})}, 1,
                                      {.mipmaps = true, .second_textures = true});
    EXPECT_TRUE(plan.targets[0].two_textures && plan.targets[0].mipmaps);
    EXPECT_FALSE(plan.targets[1].two_textures || plan.targets[1].mipmaps);
}

TEST(PlanFrame, discarded_pixels_come_from_an_earlier_frame) {
    const Reflections programs{with({}), with({"iChannel0"})};
    scene::Scene scene = scene_of(2);
    scene.passes[1].channels[0] = reads(0);
    const FramePlan image = plan_frame(scene, programs, 1, {}, {1});
    EXPECT_TRUE(image.feedback);
    EXPECT_FALSE(image.targets[1].two_textures) << "as the site's canvas";
    const FramePlan buffer = plan_frame(scene, programs, 1, {}, {0});
    EXPECT_TRUE(buffer.feedback);
    EXPECT_TRUE(buffer.targets[0].two_textures) << "as the site's buffers";
    EXPECT_FALSE(plan_frame(scene_of(2), programs, 1, {}, {0}).feedback) << "nobody reads it";
}

} // namespace tidemark::render::frame_plan_test
