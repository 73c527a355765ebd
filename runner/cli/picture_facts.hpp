// What a picture shows, for its file: the facts that make it again.
#pragma once

#include "cli/requests.hpp"

#include <string>
#include <utility>
#include <vector>

namespace tidemark::cli {

/// Names and values of a picture's metadata (image::PictureFormat): the scene with its knobs, the frame with
/// its mouse and camera as the options have them, the program.
std::vector<std::pair<std::string, std::string>> metadata_of(const scene::Scene& scene,
                                                             const render::FrameState& state);

/// `AZ,EL,DIST`, and what it looks at where that is not the origin.
std::string camera_fact(const render::OrbitCamera& camera);

} // namespace tidemark::cli
