#include "cli/not_finite.hpp"

#include "base/shell_word.hpp"
#include "image/census.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace tidemark::cli {

size_t count_not_finite(const render::Renderer& renderer, image::Image& picture) {
    const scene::Pass& shown = renderer.shown_pass();
    if (shown.kind == scene::PassKind::image || picture.type == image::SampleType::f32)
        return image::take_non_finite(picture);
    size_t count = 0;
    for (int face = 0; face < (shown.kind == scene::PassKind::cubemap ? 6 : 1); ++face) {
        image::Image floats = renderer.read_floats(renderer.shown_index(), face);
        count += image::take_non_finite(floats);
    }
    return count;
}

std::string pixels_are(size_t count, const std::string& when) {
    return fmt::format("{} pixel{} {} {}", count, count > 1 ? "s" : "", when, count > 1 ? "are" : "is");
}

std::string trace_command(const SceneRequest& scene, const FrameOptions& frames, int frame) {
    std::vector<std::string> words{"tidemark", "check", "--trace", file_word(scene.path)};
    const auto add = [&](const char* option, const std::string& value) {
        words.insert(words.end(), {option, value});
    };
    const auto add_given = [&](const char* option, const std::optional<std::string>& value) {
        if (value)
            add(option, *value);
    };
    if (frames.time)
        add("--time", fmt::format("{}", *frames.time));
    else
        add("--frame", fmt::format("{}", frame));
    add("--size", frames.size);
    if (frames.fps != FrameOptions{}.fps)
        add("--fps", fmt::format("{}", frames.fps));
    add_given("--mouse", frames.mouse);
    add_given("--date", frames.date);
    add_given("--camera", frames.camera);
    add_given("--input", frames.input);
    if (!frames.pass.empty())
        add("--pass", frames.pass);
    std::ranges::copy(option_words(scene), std::back_inserter(words));
    return shell_words(words);
}

} // namespace tidemark::cli
