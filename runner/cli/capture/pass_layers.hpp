// Reads back the passes other than the shown one, as layers of its file.
#pragma once

#include "image/files/picture_file.hpp"
#include "render/renderer.hpp"

#include <string>
#include <vector>

namespace tidemark::cli {

/// Returns the other passes in the order of drawing: `Buffer A`, and for a cube `Cube A px` to `Cube A nz`.
/// Each has the orientation of a file with that pass or face alone, but always with alpha, so that all frames
/// of a sequence have the same channels.
std::vector<image::PictureLayer> other_layers(const render::Renderer& renderer, image::SampleDepth depth);

/// Returns the names of all layers, the shown pass first.
std::vector<std::string> layer_names(const render::Renderer& renderer);

} // namespace tidemark::cli
