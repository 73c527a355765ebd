// Saves what a capture needs to go on from, while it draws: which program was chosen, before the first frame,
// and every so many frames the buffers. The state before is removed when the next one is on disk.
#pragma once

#include "cli/capture/capture_plan.hpp"
#include "cli/capture/saved_state.hpp"
#include "cli/fingerprint.hpp"
#include "render/renderer.hpp"

namespace tidemark::cli {

class StateSaver {
public:
    /// All must outlive it but the fingerprint, which is the run's.
    StateSaver(const CapturePlan& plan, Fingerprint fingerprint, const render::Renderer& renderer)
        : plan_(plan), fingerprint_(std::move(fingerprint)), renderer_(renderer) {}

    /// Before the first frame: the outcome of a trial, which another run might decide otherwise.
    Result<void> save_program();
    /// Whether the buffers, which are ready for that frame, are to be saved.
    bool is_due(int frame) const;
    Result<void> save_buffers(int frame);
    /// The one that the capture goes on from: it is there already.
    void found(int frame) { last_ = frame; }

private:
    Result<void> save(const SavedState& state);

    const CapturePlan& plan_;
    Fingerprint fingerprint_;
    const render::Renderer& renderer_;
    std::optional<int> last_{}; ///< frame of the newest state on disk
};

} // namespace tidemark::cli
