// A scene that is drawn at one setting after the other, and recompiled only if a setting needs another
// program. Its context must be current as long as it lives.
#pragma once

#include "lab/study/specimen.hpp"
#include "lab/study/turnable_scene.hpp"

#include <optional>
#include <vector>

namespace tidemark::lab {

class TurnedSpecimen {
public:
    /// `scene` must outlive the object.
    TurnedSpecimen(const scene::Scene& scene, Extent extent, HitSource hits)
        : scene_(scene), extent_(extent), hits_(hits) {}

    /// Returns the scene at these settings, valid until the next call. The error is that of the author's own
    /// text.
    Result<Specimen*> at(const std::vector<Setting>& settings, glsl::Precision precision);

private:
    bool make_turnable(const std::vector<Setting>& settings);

    const scene::Scene& scene_;
    Extent extent_;
    HitSource hits_;
    glsl::Precision precision_ = glsl::Precision::single;
    std::optional<TurnableScene> turnable_; ///< source of `specimen_`; nullopt: the scene's own text
    std::optional<Specimen> specimen_;
    bool own_text_only_ = false; ///< the driver rejects the text with uniforms
};

} // namespace tidemark::lab
