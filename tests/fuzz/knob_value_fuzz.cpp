// `--set` values: the first byte chooses the type, the rest is the value. What is taken can be printed and is
// then taken again as the same.
#include "fuzz.hpp"
#include "scene/knob.hpp"

#include <cmath>

using namespace tidemark;

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    if (size == 0)
        return 0;
    scene::Knob knob;
    knob.name = "k";
    knob.type = scene::KnobType(data[0] % 9);
    const auto value = scene::parse_knob_value(knob, text_of(data + 1, size - 1));
    if (!value) {
        REQUIRE(value.error().code == ErrorCode::usage && !value.error().message.empty());
        return 0;
    }
    const scene::KnobTypeInfo& type = scene::info(knob.type);
    for (size_t i = 0; i < value->size(); ++i) {
        REQUIRE(std::isfinite((*value)[i]));
        REQUIRE(i < size_t(type.components) || (*value)[i] == 0);
        REQUIRE(!type.whole || double(int((*value)[i])) == (*value)[i]);
    }
    const auto again = scene::parse_knob_value(knob, scene::to_string(knob, *value));
    REQUIRE(again && *again == *value);
    return 0;
}
