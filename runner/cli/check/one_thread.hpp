// Draws pictures with one thread, in a child process: llvmpipe reads its number of threads when it starts.
#pragma once

#include "cli/forked.hpp"
#include "lab/check/probe_bench.hpp"
#include "platform/device_choice.hpp"

#include <string>

namespace tidemark::cli {

/// Starts a process that sleeps until `drawn_by`. Call it before this process has a context.
Result<ForkedHelper> one_thread_painter(const scene::Scene& scene, const platform::DeviceChoice& device);

/// Returns true if the driver of the current context can be limited to one thread.
bool counts_threads();

/// Draws the picture, once: RGB of Image as ProbeBench::picture returns it.
Result<image::Image> drawn_by(ForkedHelper& painter, const render::FrameState& state, double seconds);

} // namespace tidemark::cli
