// Makes a placeholder for a missing picture, cube or volume: a cloudy texture in a few colours with values of
// the middle range. The same name gives the same bytes.
#pragma once

#include "image/files/cubemap_file.hpp"
#include "image/image.hpp"
#include "image/volume.hpp"

#include <string_view>

namespace tidemark::image {

/// Makes a picture of u8 samples, 1 to 4 channels (of 2 and 4 the last is alpha, 255). Pictures and volumes
/// tile seamlessly.
Image make_stand_in_picture(std::string_view name, Extent size, int channels);

/// Makes a placeholder for a camera's picture.
Image make_stand_in_camera();

/// Makes a cube without seams between the faces.
CubeFaces make_stand_in_cube(std::string_view name, int side, int channels);

VolumeData make_stand_in_volume(std::string_view name, int width, int height, int depth, int channels);

} // namespace tidemark::image
