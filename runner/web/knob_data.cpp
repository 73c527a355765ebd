#include "web/knob_data.hpp"

#include <nlohmann/json.hpp>

#include <vector>

namespace tidemark::web {
namespace {

Json numbers(const scene::KnobValue& value, int count) {
    return Json(std::vector<double>(value.begin(), value.begin() + count));
}

} // namespace

Json knob_data(const scene::Knob& knob) {
    const scene::KnobTypeInfo& type = info(knob.type);
    Json data = {{"name", knob.name},
                 {"colour", knob.type == scene::KnobType::color3},
                 {"whole", type.whole},
                 {"value", numbers(knob.value, type.components)}};
    if (knob.range) {
        data["low"] = numbers(knob.range->low, type.components);
        data["high"] = numbers(knob.range->high, type.components);
    }
    if (knob.step)
        data["step"] = numbers(*knob.step, type.components);
    return data;
}

} // namespace tidemark::web
