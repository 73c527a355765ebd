#include "image/files/video_encoding.hpp"

#include <algorithm>

namespace tidemark::image {
namespace {

using Words = std::vector<std::string>;

/// The filter that makes rows go from the top down and says by which matrix colours were coded.
constexpr const char* k_upright_bt709 = "vflip,scale=out_color_matrix=bt709:out_range=tv";
constexpr const char* k_palettes = "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1";

Words bt709(Words encoder) {
    for (const char* word : {"-vf", k_upright_bt709, "-colorspace", "bt709", "-color_primaries", "bt709",
                             "-color_trc", "iec61966-2-1"})
        encoder.emplace_back(word);
    return encoder;
}

/// Half the colour resolution, which every player takes, needs even sizes in H.264.
Words h264(Extent extent) {
    const bool even = extent.width % 2 == 0 && extent.height % 2 == 0;
    return bt709({"-c:v", "libx264", "-crf", "18", "-pix_fmt", even ? "yuv420p" : "yuv444p"});
}

Words vp9(Extent) {
    return bt709({"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-cpu-used", "4", "-row-mt", "1",
                  "-pix_fmt", "yuv420p"});
}

/// Of 4444 all colours are kept, in 10 bits, and sound as it is. The encoder takes what frames say of their
/// colours.
Words prores() {
    return {"-vf",
            "scale=out_color_matrix=bt709:out_range=tv,"
            "setparams=colorspace=bt709:color_primaries=bt709:color_trc=iec61966-2-1",
            "-c:v",
            "prores_ks",
            "-profile:v",
            "4444",
            "-pix_fmt",
            "yuv444p10le",
            "-vendor",
            "apl0",
            "-movflags",
            "+write_colr",
            "-c:a",
            "pcm_s16le"};
}

Words lossless(Extent) {
    return {"-vf", "vflip", "-c:v", "libx264rgb", "-qp", "0", "-preset", "ultrafast", "-pix_fmt", "rgb24"};
}

} // namespace

const VideoEncoding* encoding_of(const std::filesystem::path& path) {
    static const VideoEncoding encodings[] = {
        {".mp4", h264, {"-c:v", "copy", "-c:a", "aac", "-b:a", "192k", "-movflags", "+faststart"}},
        {".webm", vp9, {"-c:v", "copy", "-c:a", "libopus"}},
        {".gif", lossless, {"-filter_complex", k_palettes, "-loop", "0"}},
        {".webp", lossless, {"-an", "-c:v", "libwebp_anim", "-lossless", "1", "-loop", "0"}},
        {".mov", lossless, prores()},
    };
    const std::string extension = path.extension().string();
    const auto* found = std::ranges::find(encodings, std::string_view(extension), &VideoEncoding::extension);
    return found == std::end(encodings) ? nullptr : found;
}

Words ffmpeg_words() {
    // Without -xerror ffmpeg ends well where a full disk kept the last blocks of the file from it.
    return {"ffmpeg", "-xerror", "-nostats", "-loglevel", "error", "-y"};
}

Words reproducible_words() {
    return {"-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-flags:a", "+bitexact"};
}

} // namespace tidemark::image
