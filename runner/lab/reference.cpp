#include "lab/reference.hpp"

#include "lab/water_surface_field.hpp"

namespace tidemark::lab {

MakeReference find_reference(std::string_view scene_name) {
    if (scene_name == "water_surface")
        return water_surface_reference;
    return nullptr;
}

} // namespace tidemark::lab
