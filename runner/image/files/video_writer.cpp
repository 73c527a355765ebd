#include "image/files/video_writer.hpp"

#include "base/try.hpp"

#include <fmt/format.h>

#include <array>
#include <cassert>

namespace tidemark::image {
namespace fs = std::filesystem;
namespace {

using Arguments = std::vector<std::string>;

struct Container {
    std::string_view extension;
    Arguments (*encoder)(Extent extent);
};

/// The filters that make rows go from the top down and, for video, say by which matrix colours were coded.
constexpr const char* k_upright_bt709 = "vflip,scale=out_color_matrix=bt709:out_range=tv";
constexpr const char* k_upright_palette =
    "vflip,split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1";

/// Half the colour resolution, which every player takes, needs even sizes in H.264.
Arguments h264(Extent extent) {
    const bool even = extent.width % 2 == 0 && extent.height % 2 == 0;
    return {"-vf",       k_upright_bt709,
            "-c:v",      "libx264",
            "-crf",      "18",
            "-pix_fmt",  even ? "yuv420p" : "yuv444p",
            "-c:a",      "aac",
            "-b:a",      "192k",
            "-movflags", "+faststart"};
}

Arguments vp9(Extent) {
    return {"-vf", k_upright_bt709, "-c:v", "libvpx-vp9", "-crf",    "24",   "-b:v",   "0", "-cpu-used",
            "4",   "-row-mt",       "1",    "-pix_fmt",   "yuv420p", "-c:a", "libopus"};
}

Arguments gif(Extent) {
    return {"-filter_complex", k_upright_palette, "-loop", "0"};
}

constexpr std::array<Container, 3> k_containers{{{".mp4", h264}, {".webm", vp9}, {".gif", gif}}};

const Container* container_of(const fs::path& path) {
    for (const Container& container : k_containers)
        if (path.extension() == container.extension)
            return &container;
    return nullptr;
}

Arguments arguments_for(const fs::path& staged, const VideoFormat& format) {
    const Container& container = *container_of(staged);
    // Without -xerror ffmpeg ends well where a full disk kept the last blocks of the file from it.
    Arguments arguments{"ffmpeg",     "-xerror",
                        "-nostats",   "-loglevel",
                        "error",      "-y",
                        "-f",         "rawvideo",
                        "-pix_fmt",   "rgb0",
                        "-s",         fmt::format("{}x{}", format.extent.width, format.extent.height),
                        "-framerate", fmt::format("{}", format.fps),
                        "-i",         "pipe:0"};
    const auto add = [&](const Arguments& more) {
        arguments.insert(arguments.end(), more.begin(), more.end());
    };
    if (!format.sound.empty())
        add({"-protocol_whitelist", "file", "-f", "wav", "-i", "file:" + format.sound.string()});
    add(container.encoder(format.extent));
    if (container.encoder != gif)
        add({"-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "iec61966-2-1"});
    // The same frames make the same file: no date, no version.
    add({"-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-flags:a", "+bitexact",
         "file:" + staged.string()});
    return arguments;
}

std::string last_line(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r'))
        text.pop_back();
    return text.substr(text.rfind('\n') + 1);
}

} // namespace

bool is_video_name(const fs::path& path) {
    return container_of(path) != nullptr;
}

Result<VideoWriter> VideoWriter::create(const OutputPath& output, const VideoFormat& format) {
    const fs::path& path = output.path();
    assert(is_video_name(path));
    auto staged = TRY(StagedFile::create(output));
    auto encoder = ChildProcess::start(arguments_for(staged.path(), format), ChildProcess::Input::written);
    if (!encoder)
        return fail(ErrorCode::write,
                    fmt::format("cannot write '{}': {}", path.string(), encoder.error().message));
    return VideoWriter(path, std::move(staged), *std::move(encoder));
}

Result<void> VideoWriter::push(const Image& image) {
    assert(image.type == SampleType::u8 && image.channels == 4);
    if (encoder_.write(image.bytes, words_))
        return {};
    return failure();
}

Result<void> VideoWriter::finish() {
    encoder_.close_input();
    std::byte none{};
    while (!encoder_.read({&none, 1}, words_)) {
        // It prints nothing and closes its output in the end; a long film may take it more than a minute.
    }
    if (!encoder_.succeeded())
        return failure();
    return staged_.commit();
}

tl::unexpected<Error> VideoWriter::failure() const {
    const std::string why = last_line(words_);
    return fail(ErrorCode::write, fmt::format("cannot write '{}': ffmpeg {}", path_.string(),
                                              why.empty() ? "ended without a word" : "says: " + why));
}

} // namespace tidemark::image
