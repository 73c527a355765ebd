// The numbers of a scene that buy exactness with time: how often loops turn, where marches stop, how long
// their steps are. Any other number is a part of the picture, and no business of ours.
#pragma once

#include "base/error.hpp"
#include "lab/setting.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tidemark::lab {

struct QualitySetting {
    Axis axis;          ///< from the coarsest value to the strictest
    size_t own = 0;     ///< which of the values is the scene's; their number: none
    std::string why{};  ///< "bounds the march at a.glsl:12"
    bool march = false; ///< it belongs to the loop that is found to march, whatever it is called
};

struct QualitySettings {
    std::vector<QualitySetting> found{};
    std::vector<std::string> left{}; ///< numbers that stand where such a number may, but are called otherwise
};

/// Of the loop of Image that is found to march.
struct MarchPlaces {
    SourceLocation test;                 ///< of its distance
    std::vector<SourceLocation> steps{}; ///< where the ray is carried on
    std::optional<double> far{};         ///< where it gives up, if that is a number of the text
};

/// By where a name stands in the text, and by what it is called where that does not tell it from a number of
/// the picture. Numbers without a name count in the loop that is found to march alone, each by its place.
QualitySettings quality_settings(const scene::Scene& scene, const std::optional<MarchPlaces>& march);

/// What is left of it where the scene as it is is the truth: what is stricter costs more, and shows something
/// else.
void leave_out_stricter(QualitySetting& setting);

/// An axis that a person gives.
QualitySetting quality_setting(const scene::Scene& scene, Axis axis);

} // namespace tidemark::lab
