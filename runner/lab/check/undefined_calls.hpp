// Calls outside of a function's domain, and how much of the picture depends on what a GPU makes of them. A
// context must be current.
#pragma once

#include "lab/check/explored.hpp"
#include "lab/check/probe_text.hpp"

#include <string>
#include <vector>

namespace tidemark::lab {

/// A moment, and the pixels that are drawn of it.
struct PictureView {
    FrameState state;
    PixelGrid grid{};
};

/// Everyday, and those in which a search saw values leave their domain.
Result<std::vector<PictureView>> usual_views(ProbeBench& bench);

/// A call that was undefined, with what depends on it.
struct UndefinedCall {
    std::string sentence;
    size_t pass = 0; ///< of the scene
    glsl::NodeId node = glsl::k_no_node;
    double percent = 0; ///< of the pixels; 0: none shows it
    FrameState where;
    image::Image picture; ///< those pixels
};

/// The most visible first. `texts` as they are linked (read_texts, not as written). The error is that of a
/// driver which refuses the text that reports.
Result<std::vector<UndefinedCall>> find_undefined(ProbeBench& bench, const std::vector<PassText>& texts,
                                                  const std::vector<PictureView>& views);

} // namespace tidemark::lab
