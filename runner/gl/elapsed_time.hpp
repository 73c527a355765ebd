// What the driver's own timer says of commands (GL_TIME_ELAPSED). It need not be true: who uses it holds it
// against a clock that is (lab/study/timing.hpp).
#pragma once

#include "gl/handle.hpp"

#include <optional>

namespace tidemark::gl {

/// Runs from its making to `stop`; one at a time in a context.
class ElapsedTime {
public:
    ElapsedTime();

    void stop();
    /// Waits for the commands between. Nothing: the driver has no such timer.
    std::optional<double> milliseconds() const;

private:
    QueryHandle query_;
};

} // namespace tidemark::gl
