// A drawn frame of a capture: its pixels and its record.
#pragma once

#include "cli/capture/frame_records.hpp"
#include "image/image.hpp"

namespace tidemark::cli {

struct DrawnFrame {
    FrameRecord record;
    image::Image picture;
};

} // namespace tidemark::cli
