// Measures GPU time with the driver's timer (GL_TIME_ELAPSED). The timer may be wrong: users compare it with
// a wall clock, as a study of the lab does.
#pragma once

#include "gl/handle.hpp"

#include <optional>

namespace tidemark::gl {

/// Runs from construction to `stop`; a context can run one at a time.
class ElapsedTime {
public:
    ElapsedTime();

    void stop();
    /// Waits for the measured commands. Returns nothing when the driver has no such timer.
    std::optional<double> milliseconds() const;

private:
    QueryHandle query_;
};

} // namespace tidemark::gl
