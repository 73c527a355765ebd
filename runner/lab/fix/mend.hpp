// Fixes the faults that probes find in a scene, one after the other. Each fix is drawn on top of those before
// it, and only one that improves the scene is offered. It writes no files. A context must be current.
#pragma once

#include "lab/fix/judged.hpp"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace tidemark::lab {

struct Offer {
    std::string finding;
    Judgement judgement;
};

/// A fault that was found and not fixed, with the reason.
struct Remaining {
    std::string finding;
    std::string why;
};

struct Mending {
    bool hashes = false; ///< also fix hashes of large sines, which changes the picture
    /// Returns whether the files can be changed by all of `cures`, the new one last.
    std::function<bool(std::span<const glsl::Cure> cures)> can_be_written;
    /// Called with each fix; the last of `cures` is the new one.
    std::function<void(const Offer& offer, std::span<const glsl::Cure> cures)> offered;
    std::function<void(const Remaining& remaining)> remains;
};

/// Repeats analysis and fixes until a round has no new fix, at most eight times.
Result<void> mend(const scene::Scene& scene, const Promises& promises, const Mending& mending);

} // namespace tidemark::lab
