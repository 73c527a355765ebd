// Loads the picture plug-in.
#pragma once

#include "base/error.hpp"
#include "media/plugin/picture_codec.hpp"

namespace tidemark::image {

/// Returns this program's picture plug-in. The first call loads it, and concurrent calls wait. A failure is
/// permanent.
const Result<const PictureCodec*>& picture_codec();

// PNG by libpng. Other formats use the picture plug-in. Nearly every capture writes PNG, and libpng alone
// needs no loading, whereas the plug-in's libraries take a quarter of a second and 120 MiB.

/// Encodes a job, whose format must be png and depth u8 or u16.
EncodeResult encode_png(const EncodeJob& job);
/// Starts a row encoder like PictureCodec::encode_rows.
RowEncoderResult encode_png_rows(const EncodeJob& job, std::FILE* file);

/// Decodes a file that `checked_file` has accepted. Expands palettes and small depths, converts a transparent
/// colour to alpha, and applies neither gamma nor a colour space. 16 bits give f32 samples, v / 65535.
DecodeResult decode_png(std::span<const std::byte> file);

} // namespace tidemark::image
