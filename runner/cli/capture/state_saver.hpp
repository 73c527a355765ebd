// Saves the states that `--resume` needs, while a capture draws: the chosen program before the first frame,
// and the buffers at regular intervals. The previous state is removed once the next one is on disk.
#pragma once

#include "cli/capture/capture_plan.hpp"
#include "cli/capture/saved_state.hpp"
#include "cli/fingerprint.hpp"
#include "render/renderer.hpp"

namespace tidemark::cli {

class StateSaver {
public:
    /// The plan and the renderer must outlive it. `fingerprint` is that of the run.
    StateSaver(const CapturePlan& plan, Fingerprint fingerprint, const render::Renderer& renderer)
        : plan_(plan), fingerprint_(std::move(fingerprint)), renderer_(renderer) {}

    /// Saves the result of a trial, which another run might decide differently. Call it before the first
    /// frame.
    Result<void> save_program();
    /// Returns true if the buffers, which are ready for that frame, should be saved.
    bool is_due(int frame) const;
    Result<void> save_buffers(int frame);
    /// Registers the state that the capture was started from, which already exists on disk.
    void found(int frame) { last_ = frame; }

private:
    Result<void> save(const SavedState& state);

    const CapturePlan& plan_;
    Fingerprint fingerprint_;
    const render::Renderer& renderer_;
    std::optional<int> last_{}; ///< frame of the newest state on disk
};

} // namespace tidemark::cli
