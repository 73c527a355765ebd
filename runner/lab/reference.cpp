#include "lab/reference.hpp"

#include "lab/gerstner_waves_field.hpp"
#include "lab/procedural_ocean_field.hpp"
#include "lab/water_surface_field.hpp"

namespace tidemark::lab {

MakeReference find_reference(std::string_view scene_name) {
    if (scene_name == "water_surface")
        return water_surface_reference;
    if (scene_name == "gerstner_waves")
        return gerstner_waves_reference;
    if (scene_name == "procedural_ocean")
        return procedural_ocean_reference;
    return nullptr;
}

} // namespace tidemark::lab
