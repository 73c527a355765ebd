// Reports pixels that are NaN or infinite, which neither a picture file nor a window shows.
#pragma once

#include "cli/options.hpp"
#include "render/renderer.hpp"

#include <string>
#include <vector>

namespace tidemark::cli {

/// Counts the pixels of the shown pass that are not finite. `picture` is its read-back: for Image the bytes
/// are marked (RenderOptions::marks_non_finite), and the marks are removed. Other passes use their alpha
/// themselves, so their floats are read instead.
size_t count_not_finite(const render::Renderer& renderer, image::Image& picture);

/// Returns `3 pixels of frame 7 are` or `1 pixel at 2.5 s is`, to be followed by ` not finite`.
std::string pixels_are(size_t count, const std::string& when);

/// Return the command that finds the line, as arguments and as shell text.
std::vector<std::string> trace_words(const SceneRequest& scene, const FrameSequence& sequence,
                                     const render::FrameState& state);
std::string trace_command(const SceneRequest& scene, const FrameSequence& sequence,
                          const render::FrameState& state);

} // namespace tidemark::cli
