#include "scene/setting.hpp"

#include <algorithm>

namespace tidemark::scene {

void set(std::vector<Setting>& settings, const Setting& setting) {
    const auto known = std::ranges::find(settings, setting.name, &Setting::name);
    if (known == settings.end())
        settings.push_back(setting);
    else
        *known = setting;
}

} // namespace tidemark::scene
