// Finds calls outside a function's domain and measures how much of the picture depends on their value. A
// context must be current.
#pragma once

#include "lab/check/explored.hpp"
#include "lab/check/probe_text.hpp"

#include <string>
#include <vector>

namespace tidemark::lab {

/// A moment and the pixels that are drawn of it.
struct PictureView {
    FrameState state;
    PixelGrid grid{};
};

/// Returns three ordinary views, and up to six in which the search saw floats leave a function's domain.
Result<std::vector<PictureView>> usual_views(ProbeBench& bench);

/// An undefined call and its effect.
struct UndefinedCall {
    std::string sentence;
    size_t pass = 0; ///< index in the scene
    glsl::NodeId node = glsl::k_no_node;
    double percent = 0; ///< of the pixels that depend on it; 0: none
    FrameState where;
    image::Image picture; ///< the difference that those pixels show
};

/// Returns the undefined calls of the views, the most visible first. `texts` come from read_texts with
/// as_written = false. Fails if the driver refuses the instrumented text.
Result<std::vector<UndefinedCall>> find_undefined(ProbeBench& bench, const std::vector<PassText>& texts,
                                                  const std::vector<PictureView>& views);

} // namespace tidemark::lab
