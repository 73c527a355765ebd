// Files of cubemaps and volumes.
//
// Converts between texels of a cubemap and directions, by the table of the OpenGL specification (8.13).
#pragma once

#include "base/error.hpp"
#include "media/image.hpp"

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::image {

struct Direction {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
};

/// A place on a face: `face` in the order +X -X +Y -Y +Z -Z, s and t 0..1 within it.
struct CubePlace {
    int face = 0;
    double s = 0.0;
    double t = 0.0;
};

/// Returns the direction of a place, not of unit length. For s and t outside 0..1 it is the direction to that
/// point in the face's plane.
Direction direction_of(const CubePlace& place);

/// Returns the intersection of a direction, of any length but 0, with the cube.
CubePlace place_of(const Direction& direction);

// Reads cubemaps from picture files, and converts them to a panorama.

/// Six square pictures of one size, channels and type, in the order +X -X +Y -Y +Z -Z. Their bytes go
/// unchanged to OpenGL's six faces: the first row of each is t = 0 of the face in the table of the OpenGL
/// specification (8.13). This is the *top* row of the face's picture in a file, unlike in every other Image.
/// The texel at s = t = 0 is seen in direction +X: (1,1,1), -X: (-1,1,-1), +Y: (-1,1,-1), -Y: (-1,-1,1), +Z:
/// (-1,1,1), -Z: (1,1,-1). ShaderToy treats its files (without vflip) and the faces of a cubemap pass in the
/// same way.
using CubeFaces = std::array<Image, 6>;

/// Reads six files, each a face, in the order above; or one file with all faces, of one of these shapes:
/// * 4:3 or 3:4, a cross: +Y above and -Y below +Z, in whose row are -X +Z +X -Z. In the tall cross -Z is
///   below -Y, upside down, so that its edge touches that of -Y.
/// * 6:1 or 1:6: the six faces from left to right or from the top.
/// * 2:1: a panorama in the form of `equirectangular_of`, resampled to faces of a quarter of its width, at
///   most 2048 texels.
/// Faces of different channels or types are converted to the same: grey is repeated, alpha 1 added, bytes
/// become floats. ErrorCode::load names the file and the error.
Result<CubeFaces> read_cubemap(const std::vector<std::filesystem::path>& files);

/// Do the same for pictures in memory, in the form that read_picture returns. Errors contain the names.
Result<CubeFaces> cube_of_faces(CubeFaces pictures, const std::array<std::string, 6>& names);
Result<CubeFaces> cube_of_picture(const Image& picture, const std::string& name = "the picture");

/// Applies ShaderToy's vflip: reverses the rows of every face and exchanges +Y and -Y. A direction then shows
/// what its mirror image (x,-y,z) showed.
CubeFaces vflipped(const CubeFaces& faces);

/// The size of ShaderToy's panorama export.
inline constexpr Extent k_panorama{4096, 2048};

/// Returns the panorama of all directions, as ShaderToy exports it (there 4096x2048): the pixel at (u, v),
/// 0..1 from the left and from the bottom, shows the direction (-cos b sin a, sin b, cos b cos a) with a = 2
/// pi u and b = pi (v - 1/2). -Z is in the middle, +X right of it. Interpolates linearly, also across edges.
/// Row 0 is the bottom row.
Image equirectangular_of(const CubeFaces& faces, Extent size = k_panorama);

// A block of samples in three dimensions, and ShaderToy's file format for it.

/// Interleaved samples, `channels` per texel, x fastest, then y, then z, as in an OpenGL 3-D texture and in
/// the file. Not padded.
struct VolumeData {
    int width = 0;
    int height = 0;
    int depth = 0;
    int channels = 1;
    SampleType type = SampleType::u8;
    std::vector<std::byte> bytes{};

    size_t samples() const { return size_t(width) * size_t(height) * size_t(depth) * size_t(channels); }
    bool operator==(const VolumeData&) const = default;
};

/// Limits of a volume: texels on a side, and bytes of samples.
inline constexpr int k_largest_volume_side = 512;
inline constexpr size_t k_largest_volume = size_t{1} << 30;

/// Reads ShaderToy's `.bin`: "BIN\0", width, height and depth as little-endian u32, u8 channels (1 to 4), u8
/// layout (ignored, as on ShaderToy), u16 format (0: u8, 10: f32), then the samples and nothing else.
/// ErrorCode::load names the file and the error.
Result<VolumeData> read_volume(const std::filesystem::path& path);

/// Does the same for the bytes of a file; `name` is its name in messages.
Result<VolumeData> volume_of(std::string_view file, const std::string& name);

} // namespace tidemark::image
