// Finds the numbers of a scene that trade exactness for time: iteration limits, thresholds of marches, step
// lengths. All other numbers belong to the picture and are left alone.
#pragma once

#include "base/error.hpp"
#include "lab/setting.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tidemark::lab {

struct QualitySetting {
    Axis axis; ///< from the coarsest value to the strictest
    size_t own = 0; ///< index of the scene's own value; the number of values if it is not among them
    std::string why{}; ///< for example "bounds the march at a.glsl:12"
    bool march = false; ///< it belongs to the marching loop, whatever its name is
};

struct QualitySettings {
    std::vector<QualitySetting> found{};
    std::vector<std::string> left{}; ///< numbers at such a place whose names do not confirm it
};

/// The places of Image's marching loop.
struct MarchPlaces {
    SourceLocation test; ///< comparison of the distance
    std::vector<SourceLocation> steps{}; ///< updates of the ray's place
    std::optional<double> far{}; ///< limit of the ray, if it is a constant of the text
};

/// Recognises numbers by the place of their names in the text, and by the names themselves if the place is
/// ambiguous. Numbers without a name count only in the marching loop, each by its place.
QualitySettings quality_settings(const scene::Scene& scene, const std::optional<MarchPlaces>& march);

/// Removes the stricter values, for a search in which the unchanged scene is the truth: they cost more and
/// look different.
void leave_out_stricter(QualitySetting& setting);

/// Converts an axis from the command line.
QualitySetting quality_setting(const scene::Scene& scene, Axis axis);

} // namespace tidemark::lab
