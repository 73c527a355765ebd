// Cubemaps from picture files, and back to a panorama.
#pragma once

#include "base/result.hpp"
#include "image/image.hpp"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace tidemark::image {

/// Six square pictures of one size, channels and type, in the order +X -X +Y -Y +Z -Z. Their bytes go to
/// OpenGL's six faces as they are: the first row of each is t = 0 of the face in the table of the OpenGL
/// specification (8.13), which is the *top* row of a face's picture in a file, other than in every other
/// Image. So the texel at s = t = 0 is seen in direction +X: (1,1,1), -X: (-1,1,-1), +Y: (-1,1,-1), -Y:
/// (-1,-1,1), +Z: (-1,1,1), -Z: (1,1,-1). This is what ShaderToy gives its files (no vflip) and the faces of
/// a cubemap pass.
using CubeFaces = std::array<Image, 6>;

/// Six files, each a face, in the order above; or one file that holds all: its shape tells how.
/// * 4:3 or 3:4, a cross: +Y above and -Y below +Z, in whose row stand -X +Z +X -Z. In the tall cross -Z is
///   below -Y, upside down, so that its edge meets that of -Y.
/// * 6:1 or 1:6: the six faces from left to right or from the top.
/// * 2:1: a panorama, as `equirectangular_of` makes it, resampled to faces of a quarter of its width, but of
///   2048 texels at most.
/// Six faces that differ in channels or type are made alike: grey is spread, alpha 1 added, bytes made
/// floats. ErrorCode::load names the file and what is wrong.
Result<CubeFaces> read_cubemap(const std::vector<std::filesystem::path>& files);

/// The same for pictures that are in memory as read_picture gives them. Names are what messages call them.
Result<CubeFaces> cube_of_faces(CubeFaces pictures, const std::array<std::string, 6>& names);
Result<CubeFaces> cube_of_picture(const Image& picture, const std::string& name = "the picture");

/// All faces in one picture, 1:6, from the top: what `cube_of_picture` takes apart again. The faces are
/// alike.
Image column_of(const CubeFaces& faces);

/// ShaderToy's vflip of a cubemap: rows of every face reversed, and +Y and -Y change places. A direction then
/// shows what its mirror image (x,-y,z) showed.
CubeFaces vflipped(const CubeFaces& faces);

/// The size of the panorama that ShaderToy exports a cube as.
inline constexpr Extent k_panorama{4096, 2048};

/// The panorama of all directions, as ShaderToy exports it (there 4096x2048): the pixel at (u, v), 0..1 from
/// the left and from the bottom, shows the direction (-cos b sin a, sin b, cos b cos a) with a = 2 pi u and
/// b = pi (v - 1/2). -Z is in the middle, +X right of it. Linear between texels, across the edges too. An
/// Image like any other: row 0 is the bottom.
Image equirectangular_of(const CubeFaces& faces, Extent size = k_panorama);

} // namespace tidemark::image
