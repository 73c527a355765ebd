#include "image/files/video_writer.hpp"

#include "base/try.hpp"
#include "image/files/file_samples.hpp"
#include "image/files/video_check.hpp"
#include "image/files/video_encoding.hpp"
#include "image/files/video_note.hpp"
#include "image/files/video_planes.hpp"
#include "image/files/video_times.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace tidemark::image {
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
                "-framerate", fmt::format("{}", format.fps)};
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

std::string last_line(std::string text) {
    while (!text.empty() && (text.back() == '\n' || text.back() == '\r'))
        text.pop_back();
    return text.substr(text.rfind('\n') + 1);
}

tl::unexpected<Error> failure(const fs::path& video, const std::string& words) {
    const std::string why = last_line(words);
    return fail(ErrorCode::write, fmt::format("cannot write '{}': ffmpeg {}", video.string(),
                                              why.empty() ? "ended without a word" : "says: " + why));
}

/// Returns the error for an ffmpeg in PATH that is another program or broken.
tl::unexpected<Error> no_video(const fs::path& video) {
    return fail(
        ErrorCode::write,
        fmt::format(
            "cannot write '{}': ffmpeg said that it is done, and what it wrote is no such video: look at "
            "the ffmpeg in PATH",
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
