// Loads the picture plug-in.
#pragma once

#include "base/result.hpp"
#include "image/plugin/picture_codec.hpp"

namespace tidemark::image {

/// Returns this program's picture plug-in. The first call loads it, and concurrent calls wait. A failure is
/// permanent.
const Result<const PictureCodec*>& picture_codec();

} // namespace tidemark::image
