// Probes that ask for something from outside of them.
#include "gl_test.hpp"
#include "lab/probes.hpp"

namespace tidemark::lab::check_gl_test {

class Threads : public render::RenderTest {
protected:
    Answer ask(const DrawElsewhere& with_one_thread) const {
        ProbeBench bench(scene_of(k_scene), {}, with_one_thread);
        const auto answer = ask_threads(bench);
        EXPECT_TRUE(answer) << to_string(answer.error());
        return *answer;
    }
    Result<image::Image> drawn(const FrameState& state) const {
        return ProbeBench(scene_of(k_scene), {}).picture(state);
    }
    static constexpr const char* k_scene =
        "void mainImage(out vec4 c, in vec2 p) { c = vec4(sin(p.x) / p.y, 0.0, iTime, 1.0); }";
};

TEST_F(Threads, TheSameBytesPass) {
    const Answer answer = ask([this](const FrameState& where) { return drawn(where); });
    EXPECT_EQ(answer.verdict, Verdict::pass) << answer.sentence;
}

TEST_F(Threads, OnePixelThatIsAnotherFails) {
    const Answer answer = ask([this](const FrameState& where) {
        auto picture = drawn(where);
        picture->bytes[3 * 4 * 4321] ^= std::byte{1};
        return picture;
    });
    EXPECT_EQ(answer.verdict, Verdict::fail);
    EXPECT_EQ(answer.sentence, "1 of 27200 pixels differ when one thread draws them all");
    EXPECT_TRUE(answer.where && answer.picture);
}

TEST_F(Threads, WithoutAWayToDrawSoThereIsNoAnswer) {
    EXPECT_EQ(ask({}).verdict, Verdict::not_applicable);
    const Answer answer =
        ask([](const FrameState&) -> Result<image::Image> { return fail(ErrorCode::timed_out, "too slow"); });
    EXPECT_EQ(answer.verdict, Verdict::not_applicable);
    EXPECT_EQ(answer.sentence, "it could not be drawn with one thread: too slow");
}

} // namespace tidemark::lab::check_gl_test
