#include "cli/view/overlay_fields.hpp"

#include "glsl/overrides.hpp"
#include "scene/overrides.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::cli {

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
