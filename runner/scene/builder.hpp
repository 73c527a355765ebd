// Puts a Scene together: takes passes in any order that refer to each other by number, and sorts them into
// drawing order.
#pragma once

#include "base/result.hpp"
#include "scene/scene.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tidemark::scene {

/// A pass under construction.
struct Draft {
    Pass pass;                  ///< PassOutput::pass is an index into the drafts
    std::filesystem::path file; ///< its source file; empty for a pass from JSON
};

/// Checks that every pass defines its entry function, sorts the drafts into drawing order (buffers as in
/// `order`, then cubemap, image, sound) and updates their references. An Image pass that a pass reads, even
/// itself, becomes a buffer, shown by a generated Image pass. Fills `passes` and adds the files that channels
/// read to `files`.
Result<void> finish_scene(Scene& scene, std::vector<Draft> drafts, const std::vector<size_t>& order);

/// Adds a file to the scene's files, once.
void note_file(Scene& scene, const std::filesystem::path& file);
/// Adds all files that a channel reads.
void note_files(Scene& scene, const Channel& channel);

} // namespace tidemark::scene
