// A knob or a definition and what it is set to, as a person writes it.
#pragma once

#include <string>
#include <vector>

namespace tidemark::scene {

struct Setting {
    std::string name;
    std::string value;

    bool operator==(const Setting&) const = default;
};

/// Instead of an earlier one of its name.
void set(std::vector<Setting>& settings, const Setting& setting);

} // namespace tidemark::scene
