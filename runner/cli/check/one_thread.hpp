// Pictures drawn by one thread, in a process of its own: llvmpipe reads how many it may have when it starts.
#pragma once

#include "cli/forked.hpp"
#include "lab/check/probe_bench.hpp"
#include "platform/device_choice.hpp"

#include <string>

namespace tidemark::cli {

/// A process that sleeps until `drawn_by` wakes it. To be made before this one has a context.
Result<ForkedHelper> one_thread_painter(const scene::Scene& scene, const platform::DeviceChoice& device);

/// Whether the driver of the context that is current lets itself be set to one thread.
bool counts_threads();

/// Once: RGB of Image as ProbeBench::picture has it.
Result<image::Image> drawn_by(ForkedHelper& painter, const render::FrameState& state, double seconds);

} // namespace tidemark::cli
