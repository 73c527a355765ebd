// The passes behind the shown one as layers of its file: what they hold once a frame is drawn.
#pragma once

#include "image/files/picture_file.hpp"
#include "render/renderer.hpp"

#include <string>
#include <vector>

namespace tidemark::cli {

/// Those of the plan, in the order of the scene: `Buffer A`, and of a cube `Cube A px` to `Cube A nz`, each
/// as a file has it that holds that pass or face alone; but alpha is always there, so that all frames of a
/// sequence have the same channels.
std::vector<image::PictureLayer> other_layers(const render::Renderer& renderer, image::SampleDepth depth);

/// The names of all layers, the shown pass first.
std::vector<std::string> layer_names(const render::Renderer& renderer);

} // namespace tidemark::cli
