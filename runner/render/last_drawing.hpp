// Whether a pass must be drawn, or still has the picture that drawing would give. Pure: what the pass reads
// decides, as values.
#pragma once

#include "render/uniform_numbers.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace tidemark::render {

/// Which picture a texture holds: another number whenever it may be another picture.
using Generation = uint64_t;

/// All that the pixels of a pass depend on, besides its program and the place it is drawn into.
struct PassInputs {
    UniformValues uniforms;
    std::vector<Generation> channels; ///< of the textures that it reads or keeps pixels of, in a fixed order

    bool operator==(const PassInputs&) const = default;
};

/// What a pass was drawn from the last time. A pass that reads its own last frame reads a new generation
/// every time, and so does a circle of passes: they are never done.
class LastDrawing {
public:
    /// Whether the target, which holds `generation`, holds what drawing from `inputs` would give.
    bool holds(const PassInputs& inputs, Generation generation) const {
        return inputs_ && generation == edition_ && *inputs_ == inputs;
    }
    void drew(PassInputs inputs, Generation generation) {
        inputs_ = std::move(inputs);
        edition_ = generation;
    }

private:
    std::optional<PassInputs> inputs_; ///< none: never drawn
    Generation edition_ = 0;           ///< the one that came of it
};

} // namespace tidemark::render
