#include "lab/study/turnable_scene.hpp"

#include "base/try.hpp"
#include "glsl/overrides.hpp"
#include "lab/compiled_words.hpp"
#include "lab/study/stricter.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::lab {
namespace {

/// Returns nullopt unless the text is a single GLSL number token: a sign is a second token.
std::optional<scene::Knob> knob_of(std::string name, const std::string& text) {
    const auto number = number_of(text);
    if (!number || text.starts_with('-'))
        return std::nullopt;
    scene::Knob knob{.name = std::move(name),
                     .type = is_int(text) ? scene::KnobType::int1 : scene::KnobType::float1};
    knob.initial[0] = knob.value[0] = *number;
    return knob;
}

} // namespace

Result<TurnableScene> TurnableScene::create(scene::Scene scene, const std::vector<Setting>& settings) {
    TurnableScene turnable(std::move(scene));
    std::vector<Setting> others;
    for (const Setting& setting : merged(settings)) {
        auto knob = knob_of(fmt::format("tidemark_setting_{}", turnable.uniforms_.size()), setting.value);
        if (knob && !is_knob(turnable.original_, setting.name))
            turnable.uniforms_.push_back({setting.name, *std::move(knob)});
        else
            others.push_back(setting);
    }
    turnable.scene_ = TRY(with(turnable.original_, others));
    TRY(turnable.put_uniforms());
    return turnable;
}

Result<void> TurnableScene::put_uniforms() {
    std::vector<Setting> names;
    for (const Uniform& uniform : uniforms_) {
        const Setting place{uniform.setting, uniform.knob.name};
        if (glsl::definition_of(scene_, uniform.setting))
            names.push_back(place);
        else
            TRY(apply(scene_, place));
    }
    glsl::define_by_variables(scene_, names);
    words_ = compiled_words(scene_);
    for (const Uniform& uniform : uniforms_)
        scene_.knobs.push_back(uniform.knob);
    return {};
}

std::optional<std::vector<scene::Knob>> TurnableScene::knobs_at(const std::vector<Setting>& settings) const {
    std::vector<Setting> turned;
    std::map<std::string, std::string> texts; // of the uniforms
    for (const Setting& setting : merged(settings)) {
        const auto uniform = std::ranges::find(uniforms_, setting.name, &Uniform::setting);
        if (uniform != uniforms_.end()) {
            const auto knob = knob_of(uniform->knob.name, setting.value);
            if (!knob || knob->type != uniform->knob.type)
                return std::nullopt;
            texts[knob->name] = setting.value;
            turned.push_back({knob->name, setting.value});
        } else if (is_knob(original_, setting.name)) {
            turned.push_back(setting);
        }
    }
    const auto plain = with(original_, settings), uniform = with(scene_, turned);
    if (!plain || !uniform || !is_program_of(*plain, texts))
        return std::nullopt;
    return uniform->knobs;
}

/// Compares the tokens, except for the uniforms and the `const` that they cannot have.
bool TurnableScene::is_program_of(const scene::Scene& plain,
                                  const std::map<std::string, std::string>& texts) const {
    auto wanted = compiled_words(plain), ours = words_;
    if (!wanted || !ours)
        return false;
    for (std::string& word : *ours)
        if (const auto text = texts.find(word); text != texts.end())
            word = text->second;
    std::erase(*ours, "const");
    std::erase(*wanted, "const");
    return ours == wanted;
}

} // namespace tidemark::lab
