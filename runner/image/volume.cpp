#include "image/volume.hpp"

#include "base/file.hpp"
#include "base/try.hpp"
#include "image/byte_order.hpp"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <span>

namespace tidemark::image {
namespace {

using namespace std::string_view_literals;

constexpr std::string_view k_signature = "BIN\0"sv;
constexpr size_t k_header = 20;

/// Parses the header in `file` for a file of `file_size` bytes; returns a volume without its samples.
Result<VolumeData> described(std::string_view file, size_t file_size, const std::string& name) {
    const auto refuse = [&](std::string_view why) {
        return fail(ErrorCode::load, fmt::format("cannot read '{}': {}", name, why));
    };
    if (!file.starts_with(k_signature))
        return refuse("it is no ShaderToy volume: it does not start with \"BIN\" and a zero byte");
    if (file.size() < k_header)
        return refuse("the file is cut short: a volume's header has 20 bytes");
    const uint32_t width = little_endian(file, 4, 4);
    const uint32_t height = little_endian(file, 8, 4);
    const uint32_t depth = little_endian(file, 12, 4);
    const uint32_t channels = little_endian(file, 16, 1);
    const uint32_t format = little_endian(file, 18, 2);
    if (width == 0 || height == 0 || depth == 0)
        return refuse(fmt::format("its size is {}x{}x{}: it has no texels", width, height, depth));
    constexpr uint32_t limit = k_largest_volume_side;
    if (width > limit || height > limit || depth > limit)
        return refuse(fmt::format("its size is {}x{}x{}; the limit is {} on a side", width, height, depth,
                                  k_largest_volume_side));
    if (channels < 1 || channels > 4)
        return refuse(fmt::format("it has {} channels; there may be 1 to 4", channels));
    if (format != 0 && format != 10)
        return refuse(
            fmt::format("its sample format is {}; known are 0 (bytes) and 10 (32-bit floats)", format));
    VolumeData volume{int(width), int(height), int(depth), int(channels),
                      format == 0 ? SampleType::u8 : SampleType::f32};
    const size_t wanted = volume.samples() * size_of(volume.type);
    if (wanted > k_largest_volume)
        return refuse(
            fmt::format("it has {} bytes of samples; the limit is {} MiB", wanted, k_largest_volume >> 20));
    if (file_size - k_header != wanted)
        return refuse(fmt::format("{}x{}x{} texels of {} channel{} are {} bytes of samples, and it has {}",
                                  width, height, depth, channels, channels == 1 ? "" : "s", wanted,
                                  file_size - k_header));
    return volume;
}

} // namespace

Result<VolumeData> volume_of(std::string_view file, const std::string& name) {
    VolumeData volume = TRY(described(file, file.size(), name));
    const auto samples = std::as_bytes(std::span(file.substr(k_header)));
    volume.bytes.assign(samples.begin(), samples.end());
    return volume;
}

/// Checks the header before it reads the whole file.
Result<VolumeData> read_volume(const std::filesystem::path& path) {
    std::error_code error;
    if (const auto size = std::filesystem::file_size(path, error);
        !error && std::filesystem::is_regular_file(path, error)) {
        std::array<char, k_header> head{};
        std::ifstream file(path, std::ios::binary);
        file.read(head.data(), head.size());
        TRY(described({head.data(), size_t(file.gcount())}, size, path.string()));
    }
    return read_file(path, k_largest_volume + k_header).and_then([&](const std::string& file) {
        return volume_of(file, path.string());
    });
}

} // namespace tidemark::image
