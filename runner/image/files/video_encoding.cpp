#include "image/files/video_encoding.hpp"

#include "base/child_process.hpp"
#include "base/try.hpp"
#include "image/files/video_times.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace tidemark::image {
namespace {

using Words = std::vector<std::string>;

/// Filters that reverse the rows and set the colour matrix.
// ffmpeg 7 takes the tags of a video from its frames, ffmpeg 5 from the options in `colour_words`.
#define TIDEMARK_BT709                                                                                       \
    "scale=out_color_matrix=bt709:out_range=tv,"                                                             \
    "setparams=range=tv:colorspace=bt709:color_primaries=bt709:color_trc=iec61966-2-1"
constexpr const char* k_upright_bt709 = "vflip," TIDEMARK_BT709;
constexpr const char* k_bt709 = TIDEMARK_BT709;
#undef TIDEMARK_BT709
constexpr const char* k_palettes = "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1";

Words with(Words words, std::initializer_list<const char*> more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

Words libvpx(std::initializer_list<const char*> more) {
    return with({"-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-cpu-used", "4", "-row-mt", "1"}, more);
}

Words tagged(Words encoder) {
    const Words colours = colour_words();
    encoder.insert(encoder.end(), colours.begin(), colours.end());
    return encoder;
}

Words bt709(Words encoder) {
    return tagged(with(std::move(encoder), {"-vf", k_upright_bt709}));
}

/// Encodes with half the colour resolution, which every player supports; H.264 then needs even sizes.
Words h264(const VideoFormat& format, std::string_view) {
    const bool even = format.extent.width % 2 == 0 && format.extent.height % 2 == 0;
    return bt709({"-c:v", "libx264", "-crf", "18", "-pix_fmt", even ? "yuv420p" : "yuv444p"});
}

Words vp9(const VideoFormat&, std::string_view) {
    return bt709(libvpx({"-pix_fmt", "yuv420p"}));
}

/// The encoder's info would record the number of threads in the file. Apple's players need the tag.
Words hevc(const VideoFormat& format, std::string_view encoder) {
    const bool even = format.extent.width % 2 == 0 && format.extent.height % 2 == 0;
    return tagged({"-c:v", std::string(encoder), "-crf", "18", "-x265-params", "log-level=error:info=0",
                   "-pix_fmt", even ? "yuv420p10le" : "yuv444p10le", "-tag:v", "hvc1"});
}

Words av1(const VideoFormat&, std::string_view encoder) {
    Words words{"-c:v", std::string(encoder), "-crf", "24", "-pix_fmt", "yuv420p10le"};
    return tagged(encoder == "libsvtav1"
                      ? with(std::move(words), {"-preset", "6"})
                      : with(std::move(words), {"-b:v", "0", "-cpu-used", "6", "-row-mt", "1"}));
}

/// ProRes 4444 keeps the full colour resolution, in 10 bits, and alpha in 16. The encoder reads the colour
/// tags of the frames.
Words prores(const VideoFormat& format, std::string_view) {
    const bool alpha = format.alpha != Alpha::where_needed;
    return tagged(
        with({"-c:v", "prores_ks", "-profile:v", "4444", "-vendor", "apl0", "-movflags", "+write_colr"},
             {"-pix_fmt", alpha ? "yuva444p10le" : "yuv444p10le", "-alpha_bits", alpha ? "16" : "0"}));
}

/// Keeps frames without loss: as H.264, or as PNG if there is alpha, which H.264 lacks.
Words lossless(const VideoFormat& format, std::string_view) {
    if (format.alpha != Alpha::where_needed)
        return {"-vf", "vflip", "-c:v", "png", "-pix_fmt", "rgba"};
    return {"-vf", "vflip", "-c:v", "libx264rgb", "-qp", "0", "-preset", "ultrafast", "-pix_fmt", "rgb24"};
}

struct Encoder {
    std::string_view codec;
    std::string_view name;
    int step = 1;     ///< sides must be multiples of it
    int shortest = 1; ///< smallest side
};

/// Encoders that an ffmpeg may lack, the best first. SVT-AV1 rejects odd and small pictures.
constexpr Encoder k_encoders[] = {
    {"hevc", "libx265", 1, 16}, {"av1", "libsvtav1", 2, 64}, {"av1", "libaom-av1"}};

bool takes(const Encoder& encoder, Extent extent) {
    const auto side = [&](int length) { return length % encoder.step == 0 && length >= encoder.shortest; };
    return side(extent.width) && side(extent.height);
}

/// Returns the output of `ffmpeg -encoders`, which runs once.
const Result<std::string>& known_encoders() {
    static const Result<std::string> known =
        output_of({"ffmpeg", "-hide_banner", "-loglevel", "error", "-encoders"}, {1 << 20}, k_get_ffmpeg);
    return known;
}

} // namespace

const std::vector<VideoEncoding>& encodings() {
    using enum Alpha;
    static const Words mp4{"-c:v", "copy", "-c:a", "aac", "-b:a", "192k", "-movflags", "+faststart"};
    static const Words mkv{"-c:v", "copy", "-c:a", "aac", "-b:a", "192k"};
    static const Words webm{"-c:v", "copy", "-c:a", "libopus"};
    // VP9 stores alpha in a second stream, for which MP4 segments have no place and which hidden frames would
    // desynchronise.
    static const Words webm_alpha =
        tagged(libvpx({"-vf", k_bt709, "-pix_fmt", "yuva420p", "-auto-alt-ref", "0", "-c:a", "libopus"}));
    static const Words gif{"-filter_complex", k_palettes, "-loop", "0"};
    static const Words webp{"-an", "-c:v", "libwebp_anim", "-lossless", "1", "-loop", "0"};
    static const Words mov{"-c:v", "copy", "-movflags", "+write_colr", "-c:a", "pcm_s16le"};
    static const std::vector<VideoEncoding> all{
        {".mp4", "h264", false, {}, h264, mp4},
        {".mp4", "hevc", true, {}, hevc, with(mp4, {"-tag:v", "hvc1"})},
        {".mp4", "av1", true, {}, av1, mp4},
        {".mkv", "h264", false, {}, h264, mkv},
        {".mkv", "hevc", true, {}, hevc, mkv},
        {".mkv", "av1", true, {}, av1, mkv},
        {".webm", "vp9", false, {}, vp9, webm},
        {".webm", "vp9", false, {straight}, lossless, webm_alpha},
        {".webm", "av1", true, {}, av1, webm},
        {".mov", "prores", true, {straight, premultiplied}, prores, mov},
        {".gif", "", false, {}, lossless, gif},
        {".webp", "", false, {straight}, lossless, webp},
    };
    return all;
}

std::string_view segment_extension(const VideoEncoding& encoding) {
    return encoding.codec == "prores" ? ".mov" : ".mp4";
}

std::string_view muxer_of(std::string_view extension) {
    return extension == ".mkv" ? "matroska" : extension.substr(1);
}

const VideoEncoding* encoding_of(const std::filesystem::path& path, std::string_view codec, Alpha alpha) {
    const std::string extension = path.extension().string();
    const auto found = std::ranges::find_if(encodings(), [&](const VideoEncoding& encoding) {
        return encoding.extension == extension && (codec.empty() || encoding.codec == codec) &&
               (alpha == Alpha::where_needed || std::ranges::count(encoding.alphas, alpha) > 0);
    });
    return found == encodings().end() ? nullptr : &*found;
}

Result<std::string_view> encoder_of(std::string_view codec, Extent extent) {
    Words missing;
    for (const Encoder& encoder : k_encoders) {
        if (encoder.codec != codec || !takes(encoder, extent))
            continue;
        const std::string known = TRY(known_encoders());
        if (known.find(fmt::format(" {} ", encoder.name)) != known.npos)
            return encoder.name;
        missing.emplace_back(encoder.name);
    }
    const bool optional = std::ranges::find(k_encoders, codec, &Encoder::codec) != std::end(k_encoders);
    if (!optional)
        return std::string_view();
    if (missing.empty())
        return fail(ErrorCode::write, fmt::format("--codec {}: no encoder takes {}x{} pixels", codec,
                                                  extent.width, extent.height));
    return fail(ErrorCode::write, fmt::format("--codec {}: this ffmpeg has no {}, which that needs", codec,
                                              fmt::join(missing, " and no ")));
}

Words colour_words() {
    return {"-color_range",     "tv",    "-colorspace", "bt709",
            "-color_primaries", "bt709", "-color_trc",  "iec61966-2-1"};
}

Words ffmpeg_words() {
    // Without -xerror ffmpeg reports success when a full disk lost the last blocks of the file.
    return {"ffmpeg", "-xerror", "-nostats", "-loglevel", "error", "-y"};
}

Words reproducible_words() {
    return {"-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-flags:a", "+bitexact"};
}

} // namespace tidemark::image
