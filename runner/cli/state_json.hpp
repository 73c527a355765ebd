// Converts a FrameState to JSON and back, for other processes and for files.
#pragma once

#include "cli/json_dump.hpp"
#include "render/frame_state.hpp"

namespace tidemark::cli {

Json to_json(const render::FrameState& state);
/// Returns only the fields that differ from `FrameState{}`.
Json changes_of(const render::FrameState& state);
/// Reads the output of `to_json` or `changes_of`; missing fields are as in `FrameState{}`. Throws
/// Json::exception for JSON of another form.
render::FrameState frame_state_of(const Json& json);

} // namespace tidemark::cli
