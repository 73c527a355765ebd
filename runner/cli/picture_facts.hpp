// What a picture shows, for its file: the facts that make it again.
#pragma once

#include "cli/moment.hpp"
#include "scene/scene.hpp"

#include <string>
#include <utility>
#include <vector>

namespace tidemark::cli {

/// Of how the picture was drawn (Fingerprint).
inline constexpr const char* k_fingerprint = "Fingerprint";
/// Of the moment that it shows (Moment), as JSON.
inline constexpr const char* k_moment = "Moment";

/// Names and values of a picture's metadata (image::PictureFormat): the scene with its knobs, the frame with
/// its mouse and camera as the options have them, the program, and all that `--like` needs.
std::vector<std::pair<std::string, std::string>> metadata_of(const scene::Scene& scene, const Moment& moment);

} // namespace tidemark::cli
