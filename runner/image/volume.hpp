// A block of samples in three dimensions, and ShaderToy's file format for it.
#pragma once

#include "base/result.hpp"
#include "image/image.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::image {

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
