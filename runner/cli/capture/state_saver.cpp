#include "cli/capture/state_saver.hpp"

#include <algorithm>
#include <system_error>

namespace tidemark::cli {

Result<void> StateSaver::save_program() {
    const int first = renderer_.plan().feedback ? 0 : plan_.frames.frames.front();
    return save({first, renderer_.specialised()});
}

bool StateSaver::is_due(int frame) const {
    if (plan_.state_every == 0 || !renderer_.plan().feedback || frame <= last_.value_or(0))
        return false;
    if (!plan_.output.video())
        return frame % plan_.state_every == 0;
    return std::ranges::any_of(plan_.segments, [&](const VideoSegment& segment) {
        return segment.is_to_be_made() && segment.frames.front() == frame;
    });
}

Result<void> StateSaver::save_buffers(int frame) {
    return save({frame, renderer_.specialised(), renderer_.buffer_state()});
}

Result<void> StateSaver::save(const SavedState& state) {
    const OutputPath file = state_file(plan_.output, state.frame);
    auto written = write_state(file, state, fingerprint_.of_frame(states_of(plan_.frames)(state.frame)));
    if (!written)
        return written;
    if (last_)
        if (const OutputPath before = state_file(plan_.output, *last_); before.path() != file.path()) {
            std::error_code ignored;
            std::filesystem::remove(before.path(), ignored);
        }
    last_ = state.frame;
    return {};
}

} // namespace tidemark::cli
