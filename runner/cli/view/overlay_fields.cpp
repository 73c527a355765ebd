#include "cli/view/overlay_fields.hpp"

#include "glsl/overrides.hpp"
#include "scene/overrides.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::cli {
namespace {

live::PictureField field_of(std::string name, const gl::Texture& texture) {
    return {std::move(name), texture.id(), texture.extent};
}

void add_passes(const render::Renderer& renderer, const PassCosts& costs,
                std::vector<live::PictureField>& fields) {
    for (const render::PlannedPass& planned : renderer.plan().passes) {
        const gl::Texture& texture = renderer.target_of(planned.pass).texture;
        if (texture.target != GL_TEXTURE_2D)
            continue;
        fields.push_back(field_of(renderer.scene().passes[planned.pass].name, texture));
        fields.back().milliseconds = costs.of(planned.pass);
    }
}

void add_inputs(const render::Renderer& renderer, std::vector<live::PictureField>& fields) {
    for (const render::PlannedPass& planned : renderer.plan().passes)
        for (const int channel : planned.channels) {
            const scene::Pass& pass = renderer.scene().passes[planned.pass];
            const gl::Texture* texture = renderer.texture_at(planned.pass, channel);
            if (texture && texture->target == GL_TEXTURE_2D &&
                !source_pass(pass.channels[size_t(channel)].input))
                fields.push_back(field_of(fmt::format("{} iChannel{}", pass.name, channel), *texture));
        }
}

} // namespace

std::vector<live::KnobField> knob_fields(const scene::Scene& scene,
                                         const std::vector<scene::Setting>& turned) {
    std::vector<live::KnobField> fields;
    for (const scene::Knob& knob : scene.knobs)
        fields.push_back({knob, value_after(knob, turned)});
    return fields;
}

void add_controllers(std::vector<live::KnobField>& fields, const live::ControllerMap& map) {
    for (live::KnobField& field : fields)
        for (size_t i = 0; i < size_t(info(field.knob.type).components); ++i) {
            const live::KnobPart part{field.knob.name, i};
            const auto controller = map.controller_of(part);
            field.controllers.push_back({to_string(part, field.knob),
                                         controller ? to_string(*controller) : "", map.learning() == part});
        }
}

std::vector<live::DefinitionField> definition_fields(const scene::Scene& scene, const SceneRequest& request) {
    std::vector<scene::Setting> held;
    for (const std::string& text : request.defines)
        if (const auto split = scene::split_setting(text, "--define"))
            set(held, {std::string(split->first), std::string(split->second)});
    std::vector<live::DefinitionField> fields;
    for (const glsl::NamedText& definition : glsl::plain_numbers(scene)) {
        const auto other = std::ranges::find(held, definition.name, &scene::Setting::name);
        const bool is_held = other != held.end();
        if (auto field =
                live::definition_field(definition.name, is_held ? other->value : definition.text, is_held))
            fields.push_back(*std::move(field));
    }
    return fields;
}

std::vector<live::PictureField> picture_fields(const render::Renderer& renderer, const PassCosts& costs) {
    std::vector<live::PictureField> fields;
    add_passes(renderer, costs, fields);
    add_inputs(renderer, fields);
    return fields;
}

std::vector<std::string> view_labels(const std::vector<Moment>& views) {
    std::vector<std::string> labels;
    for (const Moment& view : views) {
        const render::FrameState& state = view.sequence.state;
        labels.push_back(fmt::format("{:.3f} s", state.seconds()));
        for (const scene::Setting& knob : state.knobs)
            labels.back() += fmt::format(", {} = {}", knob.name, knob.value);
    }
    return labels;
}

} // namespace tidemark::cli
