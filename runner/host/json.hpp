// Reads and writes JSON. Only json.cpp compiles the library's parser and writer, which are its larger
// part.
#pragma once

#include "base/error.hpp"
#include "render/frame_state.hpp"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace tidemark::host {

using Json = nlohmann::ordered_json;

/// Names and texts may hold any bytes: invalid UTF-8 is replaced.
std::string dump(const Json& json, int indent = -1);

/// Throws Json::exception if `text` is not JSON.
Json parse_json(std::string_view text);

/// Returns a value that `is_discarded()` if `text` is not JSON.
Json parse_or_discard(std::string_view text);

// Errors as JSON: a process started with run_forked sends its parent one JSON object a line, and an error is
// one of them.

Json to_json(const Error& error);
/// Returns nothing if `line` is not an error.
std::optional<Error> error_of(const Json& line);

// Converts a FrameState to JSON and back, for other processes and for files.

Json to_json(const render::FrameState& state);
/// Returns only the fields that differ from `FrameState{}`.
Json changes_of(const render::FrameState& state);
/// Reads the output of `to_json` or `changes_of`; missing fields are as in `FrameState{}`. The error is that
/// of scene::parse_knob_setting. Throws Json::exception for JSON of another form.
Result<render::FrameState> frame_state_of(const Json& json);
/// Returns the numbers that hold for a whole run, by name: `{"fps": 60}`.
Json run_numbers(const render::FrameState& state);

} // namespace tidemark::host
