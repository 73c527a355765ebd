#include "cli/not_finite.hpp"

#include "base/shell_word.hpp"
#include "image/census.hpp"

#include <fmt/format.h>

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

std::vector<std::string> trace_words(const SceneRequest& scene, const FrameSequence& sequence,
                                     const render::FrameState& state) {
    std::vector<std::string> words{"tidemark", "check", "--trace", file_word(scene.path)};
    const std::vector<std::string> options = option_words(scene, sequence.input_file, state);
    words.insert(words.end(), options.begin(), options.end());
    return words;
}

std::string trace_command(const SceneRequest& scene, const FrameSequence& sequence,
                          const render::FrameState& state) {
    return shell_words(trace_words(scene, sequence, state));
}

} // namespace tidemark::cli
