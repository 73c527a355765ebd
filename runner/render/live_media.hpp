// The current sound and picture of a window, for the inputs of a scene that have no file.
#pragma once

#include "image/image.hpp"
#include "sound/spectrum.hpp"

#include <memory>
#include <optional>

namespace tidemark::render {

struct LiveMedia {
    std::optional<sound::SignalBytes> microphone{};
    std::shared_ptr<const image::Image> webcam{}; ///< image::k_camera_extent, the bottom row first
};

} // namespace tidemark::render
