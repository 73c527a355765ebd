// What is said of a picture whose pixels are not all numbers, which neither a file nor a window shows.
#pragma once

#include "cli/options.hpp"
#include "render/renderer.hpp"

#include <string>
#include <vector>

namespace tidemark::cli {

/// How many pixels of the pass on show are not finite. `picture` is what was read back of it: Image's bytes
/// are marked (RenderOptions::marks_non_finite), and its marks are taken away; another pass has an alpha of
/// its own, so its floats are looked at.
size_t count_not_finite(const render::Renderer& renderer, image::Image& picture);

/// `3 pixels of frame 7 are`, `1 pixel at 2.5 s is`: before ` not finite`.
std::string pixels_are(size_t count, const std::string& when);

/// The command that finds the line, in words; and as it is typed.
std::vector<std::string> trace_words(const SceneRequest& scene, const FrameSequence& sequence,
                                     const render::FrameState& state);
std::string trace_command(const SceneRequest& scene, const FrameSequence& sequence,
                          const render::FrameState& state);

} // namespace tidemark::cli
