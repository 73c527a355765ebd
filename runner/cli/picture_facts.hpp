// The metadata of a picture's file: the facts from which it can be drawn again.
#pragma once

#include "cli/moment.hpp"
#include "scene/scene.hpp"

#include <string>
#include <utility>
#include <vector>

namespace tidemark::cli {

/// Metadata key of the Fingerprint.
inline constexpr const char* k_fingerprint = "Fingerprint";
/// Metadata key of the Moment, as JSON.
inline constexpr const char* k_moment = "Moment";

/// Returns the names and values of a picture's metadata (image::PictureFormat): the scene with its knobs, the
/// frame with its mouse and camera in the options' format, the program, and the moment that `--like` reads.
std::vector<std::pair<std::string, std::string>> metadata_of(const scene::Scene& scene, const Moment& moment);

} // namespace tidemark::cli
