// Cures for what the probes find in a scene, one after the other: each is drawn on top of those before it,
// and only one that makes the scene better is offered. A context must be current.
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

/// What was found and is not mended.
struct Remaining {
    std::string finding;
    std::string why;
};

struct Mending {
    bool hashes = false; ///< of large sines, too: their cure is another picture
    /// Whether the files can be written so; `cures` are all of them, the new one last.
    std::function<bool(std::span<const glsl::Cure> cures)> can_be_written;
    /// The last one of `cures` is new.
    std::function<void(const Offer& offer, std::span<const glsl::Cure> cures)> offered;
    std::function<void(const Remaining& remaining)> remains;
};

/// Looks again after each round of cures, until a round has none.
Result<void> mend(const scene::Scene& scene, const Promises& promises, const Mending& mending);

} // namespace tidemark::lab
