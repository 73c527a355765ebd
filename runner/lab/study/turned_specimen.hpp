// A scene at one setting after the other, compiled again only for what is another program. A context must be
// current as long as it lives.
#pragma once

#include "lab/study/specimen.hpp"
#include "lab/study/turnable_scene.hpp"

#include <optional>
#include <vector>

namespace tidemark::lab {

class TurnedSpecimen {
public:
    /// The scene stays where it is.
    TurnedSpecimen(const scene::Scene& scene, Extent extent, HitSource hits)
        : scene_(scene), extent_(extent), hits_(hits) {}

    /// Until it is asked again. The error is that of the author's own text.
    Result<Specimen*> at(const std::vector<Setting>& settings, glsl::Precision precision);

private:
    bool make_turnable(const std::vector<Setting>& settings);

    const scene::Scene& scene_;
    Extent extent_;
    HitSource hits_;
    glsl::Precision precision_ = glsl::Precision::single;
    std::optional<TurnableScene> turnable_; ///< what `specimen_` is made of; none: the scene's own text
    std::optional<Specimen> specimen_;
    bool own_text_only_ = false; ///< the driver takes no other
};

} // namespace tidemark::lab
