// PNG, by libpng. The other formats go through the picture plug-in; this one is what nearly every capture
// writes, and libpng alone is ready at once where the plug-in's libraries take a quarter of a second and 120
// MiB.
#pragma once

#include "image/plugin/picture_codec.hpp"

namespace tidemark::image {

/// The job's format must be png, its depth u8 or u16.
EncodeResult encode_png(const EncodeJob& job);
/// As PictureCodec::encode_rows.
RowEncoderResult encode_png_rows(const EncodeJob& job, std::FILE* file);

/// Of a file that `checked_file` has let through. Palettes and small depths are expanded, a transparent
/// colour becomes alpha; no gamma and no colour space is applied. 16 bits give f32 samples, v / 65535.
DecodeResult decode_png(std::span<const std::byte> file);

} // namespace tidemark::image
