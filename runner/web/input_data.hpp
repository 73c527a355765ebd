// A channel's input as JSON: files of the scene embedded whole in base 64, generated pictures as PNG.
#pragma once

#include "base/result.hpp"
#include "scene/channel.hpp"
#include "web/json.hpp"

namespace tidemark::web {

/// Bytes of the largest file that is embedded in a page.
inline constexpr size_t k_largest_file = size_t{64} << 20;

/// Returns an object whose `kind` determines the other members (host/inputs.js). Not for a PassOutput. Fails
/// (ErrorCode::load) on a file that cannot be read or is too large.
Result<Json> input_data(const scene::Channel& channel);

} // namespace tidemark::web
