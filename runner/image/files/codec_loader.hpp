// Loads the picture plug-in.
#pragma once

#include "base/result.hpp"
#include "image/plugin/picture_codec.hpp"

namespace tidemark::image {

/// The plug-in of this program (base/plug_in.hpp). Loaded by the first call; others wait for it. A failure is
/// kept.
const Result<const PictureCodec*>& picture_codec();

} // namespace tidemark::image
