// Proves the first hits of a scene's rays from its text, and compares them with the scene's own march.
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

/// The ray of a pixel that enters a marching loop.
struct ProvedRay {
    glm::ivec2 pixel{0};
    size_t loop = 0; ///< index in PassFunction::loops
    enum class Outcome {
        agrees, ///< the march ends at its first hit, or has none and finds none
        steps_over, ///< the march ends past its first hit
        misses, ///< the march ends without a hit, but there is one
        undecided,       ///< see `reason`
        unknown_texture, ///< the march reads a texture whose texels are not available
        unfaithful       ///< the loop carries more than the place on the ray
    } outcome = Outcome::undecided;
    ir::FirstHit::Reason reason = ir::FirstHit::Reason::none;
    uint64_t evaluations = 0;
    size_t turns = 0; ///< of the march
    /// The march was below the threshold at a place where that is excluded: a bug in Tidemark.
    bool contradicted = false;
    /// The march reads a texture whose mipmap level the device chooses, and the proof does not hold for all
    /// levels: it is for the base level only, if it succeeds.
    bool at_base_level = false;
};

/// Proves the ray of a pixel, with the pass's textures; nullopt if it enters no marching loop.
std::optional<ProvedRay> prove_ray(const PassFunction& function, const ir::FloatEvaluator& pixel,
                                   const ir::TextureSet& textures, glm::ivec2 at, uint64_t most_evaluations);

struct RayCounts {
    size_t rays = 0; ///< number of rays that entered a loop
    size_t agree = 0, step_over = 0, miss = 0, undecided = 0, unknown_texture = 0, unfaithful = 0,
           contradicted = 0;
    size_t at_base_level = 0;
    std::array<size_t, ir::k_reasons> reasons{}; ///< of the undecided rays
    std::optional<size_t> wrong_loop{}; ///< of the first ray that steps over or misses
    std::vector<double> evaluations{}; ///< of the rays for which a proof was tried

    void add(const ProvedRay& ray);
    size_t decided() const { return agree + step_over + miss; }
    /// Returns the most common reason of the undecided rays.
    ir::FirstHit::Reason commonest() const;
};

} // namespace tidemark::lab
