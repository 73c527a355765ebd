// A FrameState's way from one process to another.
#pragma once

#include "cli/json_dump.hpp"
#include "render/frame_state.hpp"

namespace tidemark::cli {

Json to_json(const render::FrameState& state);
/// Of what to_json made.
render::FrameState frame_state_of(const Json& json);

} // namespace tidemark::cli
