// ffmpeg's options for each kind of video: for encoding a segment, and for joining segments.

#include "media/video_output.hpp"

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/process.hpp"
#include "media/file_samples.hpp"
#include "media/video_input.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::image {

/// An encoding of a file type: H.264, HEVC and AV1 (with AAC) in .mp4 and .mkv, VP9 and AV1 (with Opus) in
/// .webm, ProRes 4444 (with PCM) in .mov; colours as BT.709. A GIF has a palette per frame, a WebP keeps all
/// bytes. These two, and VP9 with alpha, are encoded when segments are joined; until then the frames are
/// stored without loss.
struct VideoEncoding {
    std::string_view extension;
    std::string_view codec;    ///< as --codec names it; empty: unnamed
    bool ten_bits;             ///< per sample; else 8
    std::vector<Alpha> alphas; ///< supported kinds
    /// Returns the options for a segment, a file without sound, with that encoder (`encoder_of`).
    std::vector<std::string> (*segment)(const VideoFormat& format, std::string_view encoder);
    /// Options for joining segments and sound.
    std::vector<std::string> whole;
};

/// Returns the file extension of segments: ProRes needs .mov, because MP4 has no ProRes.
std::string_view segment_extension(const VideoEncoding& encoding);

/// Finds an encoding by the file's extension, the codec (empty: the extension's default) and the required
/// alpha; null if there is none.
const VideoEncoding* encoding_of(const std::filesystem::path& path, std::string_view codec = {},
                                 Alpha alpha = Alpha::where_needed);

/// Returns the colour tags for planes of 10 bits, which are BT.709 already.
std::vector<std::string> colour_words();

namespace {

// ISO/IEC 14496-12, 8.1.2: a box begins with its size and its type; players skip `free`. Ours contains the
// note, the checksum of all bytes before it, and the size of the box again, so that it can be found from the
// end.
constexpr std::string_view k_type = "free";
constexpr size_t k_checksum = 64;
constexpr size_t k_frame = 4 + k_type.size() + k_checksum + 4;

std::string bytes_of(size_t size) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes += char(size >> shift & 0xff);
    return bytes;
}

std::string checksum_of(std::string_view video, std::string_view box) {
    Sha256 hash;
    hash.add(std::as_bytes(std::span(video)));
    hash.add(std::as_bytes(std::span(box)));
    return hash.digits();
}

} // namespace

std::string note_box(std::string_view video, std::string_view note) {
    const std::string size = bytes_of(note.size() + k_frame);
    std::string box = size;
    box.append(k_type).append(note);
    return box.append(checksum_of(video, box)).append(size);
}

std::optional<std::string> note_at_end(std::string_view file) {
    if (file.size() < k_frame)
        return std::nullopt;
    const size_t size = big_endian(file, file.size() - 4, 4);
    if (size < k_frame || size > file.size())
        return std::nullopt;
    const std::string_view video = file.substr(0, file.size() - size);
    const size_t header = 4 + k_type.size();
    const std::string_view note = file.substr(video.size() + header, size - k_frame);
    if (file.substr(video.size()) != note_box(video, note))
        return std::nullopt;
    return std::string(note);
}

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
constexpr const char* k_palette_filter =
    "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1";

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
    static const Words gif{"-filter_complex", k_palette_filter, "-loop", "0"};
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

/// Returns ffmpeg's format name for files of that extension.
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

/// Returns ffmpeg's name of the first encoder of that codec that this ffmpeg has and that supports the size.
/// Empty for a codec without a choice of encoders. Fails (ErrorCode::write) if none fits.
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
    return fail(ErrorCode::write, fmt::format("--codec {}: this ffmpeg lacks the encoder {}", codec,
                                              fmt::join(missing, " and ")));
}

Words colour_words() {
    return {"-color_range",     "tv",    "-colorspace", "bt709",
            "-color_primaries", "bt709", "-color_trc",  "iec61966-2-1"};
}

/// Returns the start of the command line for encoding and joining.
Words ffmpeg_words() {
    // Without -xerror ffmpeg reports success when a full disk lost the last blocks of the file.
    return {"ffmpeg", "-xerror", "-nostats", "-loglevel", "error", "-y"};
}

/// Returns options that keep date and version out of the file, so that equal frames give equal files.
Words reproducible_words() {
    return {"-map_metadata", "-1", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-flags:a", "+bitexact"};
}

namespace fs = std::filesystem;
namespace {

using Words = std::vector<std::string>;

/// The limit for reading a segment back to check it; larger than real segments.
constexpr size_t k_largest_segment = size_t{1} << 34;

template <class... More>
Words joined(Words words, const More&... more) {
    (words.insert(words.end(), more.begin(), more.end()), ...);
    return words;
}

/// Returns ffmpeg's pixel format of the frames that `SegmentWriter::push` sends.
const char* layout_of(const VideoEncoding& encoding, Alpha alpha) {
    const bool has_alpha = alpha != Alpha::where_needed;
    if (encoding.ten_bits)
        return has_alpha ? "yuva444p10" : "yuv444p10";
    return has_alpha ? "rgba" : "rgb0";
}

/// Names the staged file through /proc of this process, so that an ffmpeg that outlives us (kill -9) does not
/// create a file where the next run has cleaned up.
std::string output_for_ffmpeg(const StagedFile& staged) {
    return fmt::format("file:/proc/{}/fd/{}", ::getpid(), staged.descriptor());
}

Words words_for_segment(const StagedFile& staged, const VideoEncoding& encoding, const VideoFormat& format,
                        std::string_view encoder) {
    Words input{"-f",         "rawvideo",
                "-pix_fmt",   layout_of(encoding, format.alpha),
                "-s",         fmt::format("{}x{}", format.extent.width, format.extent.height),
                "-framerate", rate_word(format.fps)};
    if (encoding.ten_bits)
        input = joined(input, colour_words());
    return joined(ffmpeg_words(), input, Words{"-i", "pipe:0"}, encoding.segment(format, encoder),
                  reproducible_words(),
                  Words{"-f", std::string(muxer_of(segment_extension(encoding))), output_for_ffmpeg(staged)});
}

Words words_for_joining(const StagedFile& staged, const VideoEncoding& encoding, const fs::path& sound) {
    Words input{"-f", "concat", "-safe", "0", "-protocol_whitelist", "file,pipe", "-i", "pipe:0"};
    if (!sound.empty())
        input =
            joined(input, Words{"-protocol_whitelist", "file", "-f", "wav", "-i", "file:" + sound.string()});
    return joined(ffmpeg_words(), input, encoding.whole, reproducible_words(),
                  Words{"-f", std::string(muxer_of(encoding.extension)), output_for_ffmpeg(staged)});
}

/// Quotes a path for ffmpeg's lists of files.
std::string quoted(const fs::path& path) {
    std::string text = "'file:";
    for (const char c : fs::absolute(path).string())
        text += c == '\'' ? "'\\''" : std::string(1, c);
    return text + "'";
}

/// Lists the segments for ffmpeg. Their start times are rounded to microseconds one by one instead of adding
/// rounded lengths, so that each frame gets the same tick of the video's clock as without joins.
std::string list_of(std::span<const SegmentFile> segments, double fps) {
    std::string list = "ffconcat version 1.0\n";
    size_t frames = 0;
    const auto microseconds = [&] { return std::llround(1e6 * double(frames) / fps); };
    for (const SegmentFile& segment : segments) {
        const auto start = microseconds();
        frames += segment.frames;
        list += fmt::format("file {}\nduration {}us\n", quoted(segment.path), microseconds() - start);
    }
    return list;
}

tl::unexpected<Error> failure(const fs::path& video, const std::string& words) {
    const std::string why = last_line(words);
    return fail(ErrorCode::write, fmt::format("cannot write '{}': ffmpeg {}", video.string(),
                                              why.empty() ? "ended without a message" : "says: " + why));
}

/// Returns the error for an ffmpeg in PATH that is another program or broken.
tl::unexpected<Error> no_video(const fs::path& video) {
    return fail(
        ErrorCode::write,
        fmt::format(
            "cannot write '{}': ffmpeg reported success, but wrote no valid video: check the ffmpeg in PATH",
            video.string()));
}

Result<ChildProcess> start(const Words& words, const fs::path& video) {
    auto encoder = ChildProcess::start(words, ChildProcess::Input::written, k_get_ffmpeg);
    if (!encoder)
        return fail(ErrorCode::write,
                    fmt::format("cannot write '{}': {}", video.string(), encoder.error().message));
    return encoder;
}

/// Waits for the end of ffmpeg, which prints nothing meanwhile; a long film may take it more than a minute.
bool ended_well(ChildProcess& encoder, std::string& words) {
    encoder.close_input();
    std::byte none{};
    while (!encoder.read({&none, 1}, words)) {
    }
    return encoder.succeeded();
}

} // namespace

bool is_video_name(const fs::path& path) {
    return encoding_of(path) != nullptr;
}

std::vector<std::string_view> codecs_of(const fs::path& path) {
    std::vector<std::string_view> codecs;
    for (const VideoEncoding& encoding : encodings())
        if (encoding.extension == path.extension().string() && !encoding.codec.empty() &&
            std::ranges::find(codecs, encoding.codec) == codecs.end())
            codecs.push_back(encoding.codec);
    return codecs;
}

bool has_ten_bits(const fs::path& path, std::string_view codec) {
    const VideoEncoding* const encoding = encoding_of(path, codec);
    return encoding && encoding->ten_bits;
}

bool odd_sides_keep_colours(const fs::path& path, std::string_view codec) {
    const VideoEncoding* const encoding = encoding_of(path, codec);
    return encoding && (encoding->codec == "h264" || encoding->codec == "hevc");
}

std::string rate_word(double fps) {
    constexpr double k_nearly = 1e-9;
    const double whole = std::round(fps * 1001);
    const bool is_fraction = std::abs(fps * 1001 - whole) < k_nearly * whole;
    return is_fraction && std::round(fps) != fps && whole < 1e9 ? fmt::format("{:.0f}/1001", whole)
                                                                : fmt::format("{}", fps);
}

bool video_holds_alpha(const fs::path& path, std::string_view codec, Alpha alpha) {
    return encoding_of(path, codec, alpha) != nullptr;
}

std::string_view segment_extension(const fs::path& video) {
    return segment_extension(*encoding_of(video));
}

Result<SegmentWriter> SegmentWriter::create(const OutputPath& segment, const fs::path& video,
                                            const VideoFormat& format) {
    const VideoEncoding* const encoding = encoding_of(video, format.codec, format.alpha);
    assert(encoding);
    auto staged = TRY(StagedFile::create(segment));
    const auto name = TRY(encoder_of(encoding->codec, format.extent));
    auto encoder = TRY(start(words_for_segment(staged, *encoding, format, name), video));
    return SegmentWriter(video, encoding->ten_bits, format.alpha, std::move(staged), std::move(encoder));
}

Result<void> SegmentWriter::push(const Image& image) {
    assert(image.channels == 4);
    TRY(staged_.check_is_there());
    const auto hand_over = [&](std::span<const std::byte> bytes) -> Result<void> {
        return encoder_.write(bytes, words_) ? Result<void>() : failure(video_, words_);
    };
    const auto planes_of = [&](const Image& shown) {
        return ten_bit_planes(shown, alpha_ != Alpha::where_needed);
    };
    if (ten_bits_) {
        const auto planes =
            alpha_ == Alpha::premultiplied ? planes_of(premultiplied(image)) : planes_of(image);
        return hand_over(std::as_bytes(std::span(planes)));
    }
    return image.type == SampleType::u8 ? hand_over(image.bytes)
                                        : hand_over(file_samples(image, SampleDepth::u8));
}

Result<void> SegmentWriter::finish(std::string_view note) {
    if (!ended_well(encoder_, words_))
        return failure(video_, words_);
    TRY(staged_.check_is_there());
    if (!is_video_of(staged_.path(), muxer_of(segment_extension(video_))))
        return no_video(video_);
    const std::string file = TRY(read_file(staged_.path(), k_largest_segment));
    ::lseek(staged_.descriptor(), 0, SEEK_END);
    const std::string box = note_box(file, note);
    TRY(staged_.write(std::as_bytes(std::span(box))));
    return staged_.commit();
}

std::optional<std::string> note_of_segment(const fs::path& segment) {
    const auto file = read_file(segment, k_largest_segment);
    return file ? note_at_end(*file) : std::nullopt;
}

Result<void> join_segments(const OutputPath& video, std::span<const SegmentFile> segments,
                           const VideoFormat& format, const fs::path& sound) {
    const VideoEncoding* const encoding = encoding_of(video.path(), format.codec, format.alpha);
    assert(encoding);
    auto staged = TRY(StagedFile::create(video));
    auto joiner = TRY(start(words_for_joining(staged, *encoding, sound), video.path()));
    std::string words;
    const std::string list = list_of(segments, format.fps);
    if (!joiner.write(std::as_bytes(std::span(list)), words) || !ended_well(joiner, words))
        return failure(video.path(), words);
    TRY(staged.check_is_there());
    if (!is_video_of(staged.path(), muxer_of(encoding->extension)))
        return no_video(video.path());
    return staged.commit();
}

} // namespace tidemark::image
