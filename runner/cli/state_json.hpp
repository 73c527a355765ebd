// A FrameState's way from one process to another, and into a file.
#pragma once

#include "cli/json_dump.hpp"
#include "render/frame_state.hpp"

namespace tidemark::cli {

Json to_json(const render::FrameState& state);
/// The same of what differs from `FrameState{}`.
Json changes_of(const render::FrameState& state);
/// Of what either made; what is not there is as in `FrameState{}`. Throws Json::exception where it is
/// another's.
render::FrameState frame_state_of(const Json& json);

} // namespace tidemark::cli
