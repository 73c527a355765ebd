// What a picture shows, for its file: the facts that make it again.
#pragma once

#include "cli/requests.hpp"

#include <string>
#include <utility>
#include <vector>

namespace tidemark::cli {

/// Of one frame.
struct FrameFacts {
    int frame = 0;
    double time = 0; ///< iTime
    glm::vec4 mouse{0};
    render::OrbitCamera camera{};
};

/// Names and values of a picture's metadata (image::PictureFormat): the scene with its knobs, the frame with
/// its mouse and camera as the options have them, the program.
std::vector<std::pair<std::string, std::string>> metadata_of(const scene::Scene& scene,
                                                             const FrameFacts& facts);

/// `AZ,EL,DIST`, and what it looks at where that is not the origin.
std::string to_string(const render::OrbitCamera& camera);

} // namespace tidemark::cli
