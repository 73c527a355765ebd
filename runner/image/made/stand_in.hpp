// Something to look at in the place of a picture, cube or volume that is not to be had: a cloudy texture in a
// few colours with values of the middle range. Made from a name: the same name gives the same bytes.
#pragma once

#include "image/files/cubemap_file.hpp"
#include "image/image.hpp"
#include "image/volume.hpp"

#include <string_view>

namespace tidemark::image {

/// u8 samples, 1 to 4 channels (of 2 and 4 the last is alpha, 255). Pictures and volumes tile without a seam.
Image make_stand_in_picture(std::string_view name, Extent size, int channels);

/// In the place of what a camera shows.
Image make_stand_in_camera();

/// Without a seam between the faces.
CubeFaces make_stand_in_cube(std::string_view name, int side, int channels);

VolumeData make_stand_in_volume(std::string_view name, int width, int height, int depth, int channels);

} // namespace tidemark::image
