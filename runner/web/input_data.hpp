// What a channel reads, as JSON: a file of the scene whole and in base 64, what is generated as PNG.
#pragma once

#include "base/result.hpp"
#include "scene/channel.hpp"
#include "web/json.hpp"

namespace tidemark::web {

/// The largest file that goes into a page.
inline constexpr size_t k_largest_file = size_t{64} << 20;

/// `kind` says what the rest is: see host/media.js. Not for a PassOutput. Fails (ErrorCode::load) on a file
/// that cannot be read or is too large.
Result<Json> input_data(const scene::Channel& channel);

} // namespace tidemark::web
