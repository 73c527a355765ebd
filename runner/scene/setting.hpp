// A knob or a definition and what it is set to, as a person writes it.
#pragma once

#include <string>

namespace tidemark::scene {

struct Setting {
    std::string name;
    std::string value;

    bool operator==(const Setting&) const = default;
};

} // namespace tidemark::scene
