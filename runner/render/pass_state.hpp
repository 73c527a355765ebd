// State of passes between frames: compared inputs, and saved pictures.
//
// Values of uniforms with bitwise comparison.
#pragma once

#include "scene/channel.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tidemark::render {

/// The value of one uniform, in GL's order of components.
class UniformNumbers {
public:
    UniformNumbers(std::initializer_list<double> values) { append(values.begin(), values.end()); }
    explicit UniformNumbers(std::span<const double> values) { append(values.begin(), values.end()); }

    template <class Iterator>
    void append(Iterator begin, Iterator end) {
        for (; begin != end; ++begin)
            values_[count_++] = double(*begin);
    }
    operator std::span<const double>() const { return {values_.data(), count_}; }

    /// Compares bits: a NaN equals itself, and -0 differs from 0. A shader can distinguish them.
    bool operator==(const UniformNumbers& other) const {
        const auto bits = [](double value) { return std::bit_cast<uint64_t>(value); };
        return std::ranges::equal(std::span<const double>(*this), std::span<const double>(other), {}, bits,
                                  bits);
    }

private:
    /// The length of iChannelResolution, the longest value.
    std::array<double, 3 * scene::k_channel_count> values_{};
    size_t count_ = 0;
};

/// The values of all active uniforms of a program.
using UniformValues = std::vector<UniformNumbers>;

// Decides whether a pass must be drawn or already has the resulting picture. Pure: compares the inputs of the
// pass.

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

// The state that a scene carries from one frame to the next: the pictures of the passes that the next frame
// reads.

/// RGBA, row by row from the bottom; of a cube, one face after the other.
using TextureFloats = std::vector<float>;

struct PassState {
    std::string pass;
    std::vector<TextureFloats> textures{}; ///< newest first
};

using BufferState = std::vector<PassState>;

} // namespace tidemark::render
