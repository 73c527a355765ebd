// OSC packets: from anybody, where --osc names an address that others reach.
#include "fuzz.hpp"
#include "window/osc.hpp"

using namespace tidemark;

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const scene::Knob knobs[] = {{.name = "a"}, {.name = "b", .type = scene::KnobType::ivec3}};
    const auto messages = window::parse_osc(text_of(data, size));
    if (!messages) {
        REQUIRE(!messages.error().message.empty());
        return 0;
    }
    for (const window::OscMessage& message : *messages)
        if (const auto command = osc_command(message, knobs); !command)
            REQUIRE(command.error().message.starts_with("OSC: "));
    return 0;
}
