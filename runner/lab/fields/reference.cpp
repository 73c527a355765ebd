#include "lab/fields/reference.hpp"

#include "lab/fields/gerstner_waves_field.hpp"
#include "lab/fields/procedural_ocean_field.hpp"
#include "lab/fields/water_surface_field.hpp"

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
