// Faults that were planted, each named with its line; sound shaders, of which nothing is said. The first in
// tests/cases/trace/faults, where `// born VALUE: reason; …` marks the line, the others in …/sound.
#include "gl_test.hpp"
#include "lab/nan_trace.hpp"
#include "scene/load_scene.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <bit>

namespace tidemark::lab::nan_trace_gl_test {

namespace fs = std::filesystem;

std::vector<fs::path> cases(const std::string& folder) {
    std::vector<fs::path> files;
    for (const auto& entry :
         fs::directory_iterator(fs::path(TIDEMARK_SOURCE_DIR) / "tests/cases/trace" / folder))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

std::string name_of(const testing::TestParamInfo<fs::path>& info) {
    return info.param.stem().string();
}

/// The expectation that a fault's file states in a comment.
struct Mark {
    int line = 0;
    std::string words; ///< behind `// born `
    int fix = 0;       ///< the line of `// cures`

    bool has(const std::string& text) const { return words.find(text) != std::string::npos; }
    /// Returns the number after `text`.
    int number(const std::string& text) const {
        return std::stoi(words.substr(words.find(text) + text.size()));
    }
};

Mark read_mark(const fs::path& file) {
    std::ifstream stream(file);
    Mark mark;
    std::string text;
    for (int line = 1; std::getline(stream, text); ++line) {
        if (const size_t at = text.find("// born "); at != std::string::npos) {
            mark.line = line;
            mark.words = text.substr(at + 8);
        }
        if (text.find("// cures") != std::string::npos)
            mark.fix = line;
    }
    return mark;
}

Result<std::optional<NanTrace>> trace(const fs::path& file, bool hidden, int frame = 0) {
    auto scene = scene::load_scene(file);
    if (!scene)
        return fail(std::move(scene.error()));
    auto renderer = render::Renderer::create(*std::move(scene), {{16, 9}, image::SampleType::f32, ""});
    if (!renderer)
        return fail(std::move(renderer.error()));
    TraceRequest request;
    request.states = [](int at) { return render::FrameState{.frame = at}; };
    request.hidden = hidden;
    request.frame = frame;
    return trace_nan(*renderer, request);
}

class Faults : public testing::TestWithParam<fs::path> {};

TEST_P(Faults, AreNamedWithTheirLine) {
    const Mark mark = read_mark(GetParam());
    ASSERT_GT(mark.line, 0) << "the case marks no line";
    const auto found = trace(GetParam(), mark.has("hidden"));
    ASSERT_TRUE(found) << found.error().message;
    ASSERT_TRUE(*found) << "nothing was found";
    const NanTrace& trace = **found;
    ASSERT_TRUE(trace.first);
    const NanOrigin& first = *trace.first;
    EXPECT_EQ(first.where.line, mark.line) << first.statement;
    ASSERT_TRUE(first.value);
    EXPECT_TRUE(mark.words.starts_with(worst_of(*first.value))) << worst_of(*first.value);
    if (mark.has(": ")) {
        EXPECT_TRUE(mark.has(": " + first.why.reason)) << first.why.reason;
    }
    if (mark.has("; column ")) {
        EXPECT_EQ(first.where.column, mark.number("; column "));
    }
    if (mark.has("cures column ")) {
        EXPECT_EQ(trace.fix->where.column, mark.number("cures column "));
    }
    if (mark.has("iteration ")) {
        EXPECT_EQ(first.loops.at(0).iteration, unsigned(mark.number("iteration ")));
    }
    if (mark.has("called from ")) {
        EXPECT_EQ(first.calls.back().where.line, mark.number("called from "));
    }
    if (mark.has("origin ")) {
        EXPECT_TRUE(mark.has("origin " + first.source)) << first.source;
    }
    EXPECT_EQ(trace.masked, mark.has("hidden"));
    if (!trace.masked) {
        ASSERT_TRUE(trace.fix);
        EXPECT_EQ(trace.fix->where.line, mark.fix > 0 ? mark.fix : mark.line);
    }
    EXPECT_THAT(trace.notes, testing::IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Trace, Faults, testing::ValuesIn(cases("faults")), name_of);

/// A buffer that counts frames: the pixel is +Inf in the third alone.
TEST(Feedback, ThePixelIsTracedInItsOwnFrame) {
    const TemporaryFolder folder;
    std::ofstream(folder / "buffer_a.glsl")
        << "#iChannel0 \"self\"\n"
           "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(p), 0) + 1.0; }\n";
    std::ofstream(folder / "image.glsl") << "#iChannel0 \"buffer_a.glsl\"\n"
                                            "void mainImage(out vec4 c, in vec2 p) {\n"
                                            "    float n = texelFetch(iChannel0, ivec2(p), 0).x;\n"
                                            "    float bad = 1.0 / abs(n - 3.0);\n"
                                            "    c = vec4(n == 3.0 ? bad : 0.1 * n);\n"
                                            "}\n";
    const auto found = trace(folder.path(), false, 4);
    ASSERT_TRUE(found) << found.error().message;
    ASSERT_TRUE(*found) << "nothing was found";
    const NanTrace& trace = **found;
    EXPECT_EQ(trace.frame, 2);
    EXPECT_FALSE(trace.masked);
    ASSERT_TRUE(trace.fix);
    EXPECT_EQ(trace.fix->where.line, 4);
    EXPECT_THAT(trace.notes, testing::IsEmpty());
}

class SoundShaders : public testing::TestWithParam<fs::path> {};

TEST_P(SoundShaders, AreUnchanged) {
    const auto found = trace(GetParam(), true);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_FALSE(*found) << (*found)->first->statement;
}

/// With every operation watched they draw what they drew before, but for what the driver folds differently.
TEST_P(SoundShaders, DrawTheSameWhenInstrumented) {
    auto scene = scene::load_scene(GetParam());
    ASSERT_TRUE(scene);
    auto renderer = render::Renderer::create(*std::move(scene), {{16, 9}, image::SampleType::f32, ""});
    ASSERT_TRUE(renderer);
    const render::FrameInputs inputs = render::inputs_of_frame(3, 60);
    renderer->draw(inputs);
    const size_t pass = renderer->shown_index();
    const image::Image drawn = renderer->read_floats(pass);
    const auto text = read_text(*renderer, pass);
    ASSERT_TRUE(text) << text.error().message;
    glsl::WatchRequest request;
    request.reach = glsl::WatchRequest::Reach::everything;
    const glsl::Watch watch = glsl::watch(**text, glsl::find_facts(**text), request);
    for (const PixelPlace pixel : {PixelPlace{0, 0, 0}, PixelPlace{9, 5, 0}, PixelPlace{15, 8, 0}}) {
        const auto reading = read_pixel(PassPreview(*renderer, pass, inputs), watch, pixel);
        ASSERT_TRUE(reading) << reading.error().message;
        EXPECT_TRUE(reading->arrived());
        for (size_t i = 0; i < 4; ++i)
            EXPECT_FLOAT_EQ(std::bit_cast<float>(reading->colour[i]),
                            std::bit_cast<float>(bits_at(drawn, pixel)[i]))
                << pixel.x << ',' << pixel.y;
    }
}

INSTANTIATE_TEST_SUITE_P(Trace, SoundShaders, testing::ValuesIn(cases("sound")), name_of);

} // namespace tidemark::lab::nan_trace_gl_test
