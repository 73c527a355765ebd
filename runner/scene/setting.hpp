// A knob or a definition and its value, as the user wrote them.
#pragma once

#include <string>
#include <vector>

namespace tidemark::scene {

struct Setting {
    std::string name;
    std::string value;

    bool operator==(const Setting&) const = default;
};

/// Adds a setting, replacing an earlier one of the same name.
void set(std::vector<Setting>& settings, const Setting& setting);

} // namespace tidemark::scene
