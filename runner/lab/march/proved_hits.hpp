// The first hits of a scene's rays, proved from its text, beside what its own march makes of them.
#pragma once

#include "ir/first_hit.hpp"
#include "ir/texels.hpp"
#include "lab/march/pass_function.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace tidemark::lab {

/// A ray of a pixel that enters a marching loop.
struct ProvedRay {
    glm::ivec2 pixel{0};
    size_t loop = 0; ///< in PassFunction::loops
    enum class Outcome {
        agrees,          ///< the march ends at its first hit, or has none and finds none
        steps_over,      ///< it ends behind its first hit
        misses,          ///< it ends without a hit, and there is one
        undecided,       ///< see `reason`
        unknown_texture, ///< the march reads a texture whose texels are not at hand
        unfaithful       ///< the loop carries more than the place on the ray
    } outcome = Outcome::undecided;
    ir::FirstHit::Reason reason = ir::FirstHit::Reason::none;
    uint64_t evaluations = 0;
    size_t turns = 0; ///< of the march
    /// The march was below the threshold where that was excluded: a defect of ours.
    bool contradicted = false;
    /// It reads a texture whose mipmap the device chooses, and is not decided for all of them: for the base
    /// level alone, if at all.
    bool at_base_level = false;
};

/// The ray of that pixel, with the pass's textures; nothing where it enters no marching loop.
std::optional<ProvedRay> prove_ray(const PassFunction& function, const ir::FloatEvaluator& pixel,
                                   const ir::TextureSet& textures, glm::ivec2 at, uint64_t most_evaluations);

struct RayCounts {
    size_t rays = 0; ///< that entered a loop
    size_t agree = 0, step_over = 0, miss = 0, undecided = 0, unknown_texture = 0, unfaithful = 0,
           contradicted = 0;
    size_t at_base_level = 0;
    std::array<size_t, ir::k_reasons> reasons{}; ///< of the undecided
    std::optional<size_t> wrong_loop{};          ///< of the first that steps over or misses
    std::vector<double> evaluations{};           ///< of those that were tried

    void add(const ProvedRay& ray);
    size_t decided() const { return agree + step_over + miss; }
    /// The reason of most of the undecided.
    ir::FirstHit::Reason commonest() const;
};

} // namespace tidemark::lab
