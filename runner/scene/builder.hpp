// Puts a Scene together: passes in any order that refer to each other by number come in, passes in the order
// of drawing go out.
#pragma once

#include "base/result.hpp"
#include "scene/scene.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tidemark::scene {

/// A pass under construction.
struct Draft {
    Pass pass;                  ///< PassOutput::pass counts the drafts
    std::filesystem::path file; ///< that holds it; empty for a pass of a JSON
};

/// Checks that every pass defines what its kind is called by, brings the drafts into the order of drawing
/// (buffers as `order` has them, then cubemap, image, sound) and makes their references follow. An Image
/// pass that something reads becomes a buffer, shown by an Image pass of our own. Fills `passes` and adds
/// the files that channels read to `files`.
Result<void> finish_scene(Scene& scene, std::vector<Draft> drafts, const std::vector<size_t>& order);

/// Notes a file once.
void note_file(Scene& scene, const std::filesystem::path& file);
/// Notes all files that a channel reads.
void note_files(Scene& scene, const Channel& channel);

} // namespace tidemark::scene
