// Where a capture that was cut short goes on: what its buffers held before a frame, and which program draws
// it. A file beside the frames, `frame_0120.png.state`, whole or not at all, with a checksum at its end.
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
    int frame = 0; ///< that is drawn next
    glsl::Specialise program = glsl::Specialise::nothing;
    render::BufferState buffers{}; ///< empty: as before frame 0
};

/// The largest buffer of which a state is saved, in bytes: what a driver hands over at once.
inline constexpr size_t k_largest_saved_buffer = 0x7fffffff;

/// The file of the state before a frame. A video has one for all.
OutputPath state_file(const OutputName& output, int frame);

/// The files of states that are there of an output, the latest frame first.
std::vector<std::filesystem::path> find_states(const OutputName& output);

/// All that `find_states` finds: nobody needs them any more.
void remove_states(const OutputName& output);

/// On disk, when it comes back (ErrorCode::write).
Result<void> write_state(const OutputPath& file, const SavedState& state, const Fingerprint& fingerprint);

/// What is in the file, if it is whole, no larger than `most_bytes`, and `fingerprint_of` its frame is the
/// one it was written with. No more is read of another than its first line.
std::optional<SavedState> read_state(const std::filesystem::path& file,
                                     const std::function<Fingerprint(int frame)>& fingerprint_of,
                                     uint64_t most_bytes);

} // namespace tidemark::cli
