#include "glsl/hit.hpp"

#include "glsl/survey.hpp"
#include "text/tokens.hpp"

#include <algorithm>

namespace tidemark::glsl {

std::optional<scene::Scene> hit_scene(const scene::Scene& scene) {
    const std::string_view entry = entry_point(scene::PassKind::hit);
    const auto mentions = [&](const text::MappedText& text) {
        return std::ranges::any_of(text::tokenize(text.text()),
                                   [&](const text::Token& token) { return token.is(entry); });
    };
    if (!mentions(scene.image().text) && !mentions(scene.common))
        return std::nullopt;
    scene::Scene asked = scene;
    asked.passes[scene.image_index()].kind = scene::PassKind::hit;
    return asked;
}

} // namespace tidemark::glsl
