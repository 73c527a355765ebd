// Whether a pass must be drawn, or still has the picture that drawing would give. Pure: what the pass reads
// decides, as values.
#pragma once

#include "render/uniform_numbers.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace tidemark::render {

/// Which picture a texture holds: another number whenever it may be another picture.
using Edition = uint64_t;

/// All that the pixels of a pass depend on, besides its program and the place it is drawn into.
struct PassInputs {
    UniformValues uniforms;
    std::vector<Edition> channels; ///< of the textures that it reads or keeps pixels of, in a fixed order

    bool operator==(const PassInputs&) const = default;
};

/// What a pass was drawn from the last time. A pass that reads its own last frame reads a new edition every
/// time, and so does a circle of passes: they are never done.
class LastDrawing {
public:
    /// Whether the target, which holds `edition`, holds what drawing from `inputs` would give.
    bool holds(const PassInputs& inputs, Edition edition) const {
        return inputs_ && edition == edition_ && *inputs_ == inputs;
    }
    void drew(PassInputs inputs, Edition edition) {
        inputs_ = std::move(inputs);
        edition_ = edition;
    }

private:
    std::optional<PassInputs> inputs_; ///< none: never drawn
    Edition edition_ = 0;              ///< the one that came of it
};

} // namespace tidemark::render
