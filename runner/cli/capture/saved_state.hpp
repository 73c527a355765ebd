// The state for continuing an interrupted capture: the buffers before a frame, and the program that draws it.
// It is stored next to the frames as `frame_0120.png.state`, written whole or not at all, with a checksum at
// its end.
#pragma once

#include "base/output_path.hpp"
#include "base/result.hpp"
#include "cli/fingerprint.hpp"
#include "cli/output_name.hpp"
#include "glsl/specialise/specialise.hpp"
#include "render/buffer_state.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

namespace tidemark::cli {

struct SavedState {
    int frame = 0; ///< the next frame to draw
    glsl::Specialise program = glsl::Specialise::nothing;
    render::BufferState buffers{}; ///< empty: as before frame 0
};

/// The largest buffer that can be saved, in bytes: the most that a driver reads back in one call.
inline constexpr size_t k_largest_saved_buffer = 0x7fffffff;

/// Returns the file of the state before a frame. A video has one file for all.
OutputPath state_file(const OutputName& output, int frame);

/// Returns the existing state files of an output, the latest frame first.
std::vector<std::filesystem::path> find_states(const OutputName& output);

/// Removes all files that `find_states` finds.
void remove_states(const OutputName& output);

/// Writes the state; it is on disk when the function returns. Fails with ErrorCode::write.
Result<void> write_state(const OutputPath& file, const SavedState& state, const Fingerprint& fingerprint);

/// Reads the state if the file is complete, at most `most_bytes` long, and was written with the fingerprint
/// that `fingerprint_of` returns for its frame. Otherwise only the first line is read.
std::optional<SavedState> read_state(const std::filesystem::path& file,
                                     const std::function<Fingerprint(int frame)>& fingerprint_of,
                                     uint64_t most_bytes);

} // namespace tidemark::cli
