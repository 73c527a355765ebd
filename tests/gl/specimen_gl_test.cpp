// A specimen shows in several views at once what it shows in each alone.
#include "gl_test.hpp"
#include "lab/specimen.hpp"

namespace tidemark::lab::specimen_gl_test {

class SpecimenTest : public render::RenderTest {
protected:
    /// Its Image tells the frames that were drawn and the sum of their times.
    scene::Scene counting() const {
        put("buffer_a.glsl", "#iChannel0 \"self\"\n"
                             "void mainImage(out vec4 c, in vec2 p) {\n"
                             "    c = texelFetch(iChannel0, ivec2(p), 0) + vec4(1.0, iTime, iMouse.x, 0.0);\n"
                             "}\n");
        const auto image = put("image.glsl", "#iChannel0 \"buffer_a.glsl\"\n"
                                             "void mainImage(out vec4 c, in vec2 p) {\n"
                                             "    c = texelFetch(iChannel0, ivec2(p), 0);\n}\n");
        auto scene = scene::load_scene(image.parent_path());
        EXPECT_TRUE(scene) << to_string(scene.error());
        return *std::move(scene);
    }
    static Specimen specimen(const scene::Scene& scene) {
        auto made = Specimen::create(scene, {}, {2, 2});
        EXPECT_TRUE(made) << to_string(made.error());
        return *std::move(made);
    }
};

TEST_F(SpecimenTest, views_of_a_run_equal_views_drawn_from_the_start) {
    const scene::Scene scene = counting();
    const auto views = parse_views("0.5;0.2;1.5;0.21;1@0.5,0.5");
    ASSERT_TRUE(views);
    Specimen together = specimen(scene);
    const auto pictures = together.pictures(*views);
    const float frames[] = {31, 13, 91, 13, 61};
    for (size_t i = 0; i < views->size(); ++i) {
        Specimen alone = specimen(scene);
        EXPECT_TRUE(pictures[i] == alone.picture((*views)[i])) << (*views)[i].name;
        EXPECT_EQ(pictures[i].f32()[0], frames[i]) << (*views)[i].name;
    }
}

TEST_F(SpecimenTest, a_later_moment_continues_the_earlier_run) {
    const View view{"one", render::at_time(0.51)};
    const View later = unseen(view, 0.4242);
    EXPECT_TRUE(later.state.is_in_run_of(view.state));
    EXPECT_EQ(later.state.frame, view.state.frame + 25);
    EXPECT_FALSE(render::at_time(0.52).is_in_run_of(view.state));
    render::FrameState other = later.state;
    other.mouse = render::Mouse::clicked({1, 1}, false);
    EXPECT_FALSE(other.is_in_run_of(view.state));
}

} // namespace tidemark::lab::specimen_gl_test
