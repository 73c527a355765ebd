#include "live/inputs/controller_map.hpp"

#include "live/knob_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tidemark::live {

std::string to_string(const Controller& controller) {
    return controller.channel == 1
               ? fmt::format("controller {}", controller.number)
               : fmt::format("controller {} of channel {}", controller.number, controller.channel);
}

std::string to_string(const KnobPart& part, const scene::Knob& knob) {
    if (info(knob.type).components == 1)
        return part.knob;
    const std::string_view letters = knob.type == scene::KnobType::color3 ? "rgba" : "xyzw";
    return fmt::format("{}.{}", part.knob, letters[part.component]);
}

double value_at(const scene::Knob& knob, size_t component, int midi_value) {
    const bool whole = info(knob.type).whole;
    double low = 0;
    double high = whole ? k_highest_midi_value : 1;
    if (knob.range) {
        low = knob.range->low[component];
        high = knob.range->high[component];
    }
    const double share = double(midi_value) / k_highest_midi_value;
    const double value = in_steps(knob, component, std::lerp(low, high, share));
    return whole ? std::round(value) : value;
}

void ControllerMap::learn(const KnobPart& part) {
    learning_ = learning_ == part ? std::nullopt : std::optional(part);
}

void ControllerMap::forget(const KnobPart& part) {
    std::erase_if(bindings_, [&](const Binding& binding) { return binding.part == part; });
    if (learning_ == part)
        learning_.reset();
}

std::optional<Controller> ControllerMap::controller_of(const KnobPart& part) const {
    const auto found = std::ranges::find(bindings_, part, &Binding::part);
    return found == bindings_.end() ? std::nullopt : std::optional(found->controller);
}

std::optional<TurnKnob> ControllerMap::turn(const ControlChange& change, std::span<const scene::Knob> knobs) {
    if (const auto part = std::exchange(learning_, std::nullopt)) {
        std::erase_if(bindings_, [&](const Binding& binding) {
            return binding.part == *part || binding.controller == change.controller;
        });
        bindings_.push_back({change.controller, *part});
    }
    const auto bound = std::ranges::find(bindings_, change.controller, &Binding::controller);
    if (bound == bindings_.end())
        return std::nullopt;
    const auto knob = std::ranges::find(knobs, bound->part.knob, &scene::Knob::name);
    const size_t component = bound->part.component;
    if (knob == knobs.end() || component >= size_t(info(knob->type).components))
        return std::nullopt; // the scene was edited
    scene::KnobValue value = knob->value;
    value[component] = value_at(*knob, component, change.value);
    return TurnKnob{knob->name, value};
}

} // namespace tidemark::live
