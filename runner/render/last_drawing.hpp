// Decides whether a pass must be drawn or already has the resulting picture. Pure: compares the inputs of the
// pass.
#pragma once

#include "render/uniform_numbers.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace tidemark::render {

/// Version of a texture's content: changes whenever the picture may change.
using Generation = uint64_t;

/// All that the pixels of a pass depend on, besides its program and its target.
struct PassInputs {
    UniformValues uniforms;
    std::vector<Generation> channels; ///< of the textures that it reads or keeps pixels of, in a fixed order

    bool operator==(const PassInputs&) const = default;
};

/// The inputs of the last drawing of a pass. A pass that reads its own last frame has a new generation as
/// input each time, and so has a cycle of passes: these are drawn every frame.
class LastDrawing {
public:
    /// Returns whether the target, at `generation`, already holds the result of drawing from `inputs`.
    bool holds(const PassInputs& inputs, Generation generation) const {
        return inputs_ && generation == edition_ && *inputs_ == inputs;
    }
    void drew(PassInputs inputs, Generation generation) {
        inputs_ = std::move(inputs);
        edition_ = generation;
    }

private:
    std::optional<PassInputs> inputs_; ///< empty: never drawn
    Generation edition_ = 0;           ///< of the target after drawing
};

} // namespace tidemark::render
