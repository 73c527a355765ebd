// Probes that ask for something from outside of them, and fixes.
#include "gl_test.hpp"
#include "lab/fix.hpp"
#include "lab/probes.hpp"
#include "scene/load_scene.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

namespace {
int links = 0; ///< programs linked so far
}

/// Takes the place of the library's function.
extern "C" void glLinkProgram(GLuint program) {
    static const auto link = reinterpret_cast<void (*)(GLuint)>(::dlsym(RTLD_NEXT, "glLinkProgram"));
    ++links;
    link(program);
}

namespace tidemark::lab::check_gl_test {

using namespace std::string_view_literals;

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

TEST_F(Threads, EqualPicturesPass) {
    const Answer answer = ask([this](const FrameState& where) { return drawn(where); });
    EXPECT_EQ(answer.verdict, Verdict::pass) << answer.sentence;
}

TEST_F(Threads, OneDifferentPixelFails) {
    const Answer answer = ask([this](const FrameState& where) {
        auto picture = drawn(where);
        picture->bytes[3 * 4 * 4321] ^= std::byte{1};
        return picture;
    });
    EXPECT_EQ(answer.verdict, Verdict::fail);
    EXPECT_EQ(answer.sentence, "1 of 27200 pixels differ when one thread draws them all");
    EXPECT_TRUE(answer.where && answer.picture);
}

TEST_F(Threads, WithoutAPictureOfOneThreadNotApplicable) {
    EXPECT_EQ(ask({}).verdict, Verdict::not_applicable);
    const Answer answer =
        ask([](const FrameState&) -> Result<image::Image> { return fail(ErrorCode::timed_out, "too slow"); });
    EXPECT_EQ(answer.verdict, Verdict::not_applicable);
    EXPECT_EQ(answer.sentence, "it could not be drawn with one thread: too slow");
}

TEST(SoundScenes, ProbesOfUndefinedNumbersStaySilent) {
    constexpr std::array k_names{"unassigned", "undefined", "sine", "rounding", "divergence", "mediump"};
    int answers = 0;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(TIDEMARK_SOURCE_DIR) /
                                                                 "tests/cases/trace/sound")) {
        const std::string stem = entry.path().stem();
        SCOPED_TRACE(stem);
        const auto scene = scene::load_scene(entry.path());
        ASSERT_TRUE(scene) << to_string(scene.error());
        ProbeBench bench(*scene, {});
        for (const char* name : k_names) {
            const auto answer = std::ranges::find(all_probes(), name, &Probe::name)->ask(bench);
            ASSERT_TRUE(answer) << name << ": " << to_string(answer.error());
            // One counts on variables that begin at zero, one paints the last bits.
            const std::pair asked{std::string_view(stem), std::string_view(name)};
            const bool warned = asked == std::pair{"golf"sv, "unassigned"sv} ||
                                asked == std::pair{"bit_tricks"sv, "rounding"sv};
            const bool silent =
                answer->verdict == Verdict::pass || answer->verdict == Verdict::not_applicable;
            EXPECT_NE(warned, silent) << name << ": " << answer->sentence;
            ++answers;
        }
    }
    EXPECT_GT(answers, 180);
}

class Fixes : public render::RenderTest {
protected:
    template <typename Function>
    static int links_of(const Function& function) {
        const int before = links;
        function();
        return links - before;
    }
};

TEST_F(Fixes, TheErrorIsMeasuredWithTheProgramsThatAreSearched) {
    ::setenv("TIDEMARK_CACHE", "off", 1);
    const scene::Scene scene = scene_of(
        "void mainImage(out vec4 c, in vec2 p) { c = vec4(vec3(mod(1e8 + p.x, 128.0)) / 100.0, 1.0); }");
    std::optional<double> worst;
    std::vector<std::string> said;
    const auto mend_all = [&](bool measured) {
        Mending mending{.can_be_written = [](std::span<const glsl::Cure>) { return true; },
                        .offered = [&](const Offer& offer, auto) { said.push_back(offer.finding); },
                        .remains = [&](const Remaining& each) { said.push_back(each.finding); }};
        if (measured)
            mending.measured = [&](const Result<ShownError>& error) {
                EXPECT_TRUE(said.empty());
                worst = error ? error->worst : -1;
            };
        EXPECT_TRUE(mend(scene, {}, mending));
    };
    const int both = links_of([&] { mend_all(true); });
    ASSERT_TRUE(worst);
    EXPECT_NEAR(*worst, 0.035, 1e-6); // around 1e8 a float counts in steps of 8
    const std::vector<std::string> with = std::exchange(said, {});
    const int search = links_of([&] { mend_all(false); });
    EXPECT_EQ(with, said);
    const int measurement = links_of([&] { EXPECT_TRUE(DrawnScene(scene, {}).shown_error()); });
    EXPECT_GT(measurement, 1);
    EXPECT_LT(both, search + measurement);
}

} // namespace tidemark::lab::check_gl_test
