#include "image/files/video_frames.hpp"

#include "base/child_process.hpp"
#include "base/file.hpp"
#include "image/files/video_check.hpp"
#include "image/files/video_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <optional>
#include <string>
#include <utility>

namespace tidemark::image {
namespace {

/// Beyond this many frames, a seek is faster than decoding on.
constexpr size_t k_farthest_ahead = 64;
constexpr size_t k_most_text = size_t{256} << 20;

tl::unexpected<Error> cannot_read(const std::filesystem::path& path, std::string_view why) {
    return fail(ErrorCode::load, fmt::format("cannot read '{}': {}", path.string(), why));
}

std::vector<std::string> first_arguments() {
    return {"ffmpeg", "-hide_banner", "-nostdin", "-nostats", "-loglevel", "level+info", "-copyts"};
}

/// Decodes the whole video for its frame times, for the few files that do not store them.
Result<void> replace_guessed_times(const std::filesystem::path& path, VideoTimes& times) {
    std::vector<std::string> arguments = first_arguments();
    for (std::string& argument : video_input_arguments(path))
        arguments.push_back(std::move(argument));
    for (const char* argument :
         {"-map", "0:V:0", "-vf", "showinfo=checksum=0", "-fps_mode", "passthrough", "-f", "null", "-"})
        arguments.emplace_back(argument);
    Result<ChildProcess> child = ChildProcess::start(arguments, ChildProcess::Input::none, k_get_ffmpeg);
    if (!child)
        return fail(std::move(child.error()));
    std::string words;
    std::byte none{};
    if (const Result<size_t> count = child->read({&none, 1}, words); !count)
        return fail(count.error());
    std::vector<int64_t> starts;
    for (std::string_view text = words; !text.empty();) {
        const size_t end = std::min(text.find('\n'), text.size() - 1);
        if (const auto start = showinfo_start(text.substr(0, end)))
            starts.push_back(*start);
        text.remove_prefix(end + 1);
    }
    set_starts(times, std::move(starts));
    return {};
}

std::vector<std::string> decoder_arguments(const std::filesystem::path& path, const VideoTimes& times,
                                           size_t from) {
    std::vector<std::string> arguments = first_arguments();
    // Seek to the key frame at or before the time; earlier frames are dropped below, by their own times.
    if (from > 0)
        for (std::string argument :
             {std::string("-noaccurate_seek"), std::string("-seek_timestamp"), std::string("1"),
              std::string("-ss"), fmt::format("{:.6f}", double(times.starts[from]) * times.tick)})
            arguments.push_back(std::move(argument));
    for (std::string& argument : video_input_arguments(path))
        arguments.push_back(std::move(argument));
    const std::string filters =
        fmt::format("scale={}:{}:flags=bicubic+accurate_rnd+full_chroma_int,format=rgba,vflip,"
                    "showinfo=checksum=0",
                    times.extent.width, times.extent.height);
    for (const char* argument :
         {"-map", "0:V:0", "-vf", filters.c_str(), "-fps_mode", "passthrough", "-f", "rawvideo", "pipe:1"})
        arguments.emplace_back(argument);
    return arguments;
}

struct TimedFrame {
    int64_t start = 0;
    Image image{};
};

/// One run of ffmpeg. The pixels come on its standard output; the filter `showinfo` prints each frame's time
/// on standard error before the frame is written.
class Decoder {
public:
    static Result<Decoder> start(const std::filesystem::path& path, const VideoTimes& times, size_t from) {
        Result<ChildProcess> child = ChildProcess::start(decoder_arguments(path, times, from),
                                                         ChildProcess::Input::none, k_get_ffmpeg);
        if (!child)
            return fail(std::move(child.error()));
        return Decoder(std::move(*child), times.extent);
    }

    /// Returns the next frame; nothing at the end.
    Result<std::optional<TimedFrame>> next() {
        TimedFrame frame{0, Image(extent_, 4, SampleType::u8)};
        for (size_t filled = 0; filled < frame.image.bytes.size();) {
            const Result<size_t> count = child_.read(std::span(frame.image.bytes).subspan(filled), words_);
            if (!count)
                return fail(count.error());
            take_lines();
            if (*count == 0)
                return std::optional<TimedFrame>();
            filled += *count;
        }
        child_.read_words(words_);
        take_lines();
        if (starts_.empty())
            return fail(ErrorCode::load, "ffmpeg gives a frame and no time; version 5.1 or later is needed");
        frame.start = starts_.front();
        starts_.pop_front();
        return std::optional<TimedFrame>(std::move(frame));
    }

    const std::string& complaint() const { return complaint_; }

private:
    Decoder(ChildProcess child, Extent extent) : child_(std::move(child)), extent_(extent) {}

    void take_lines() {
        size_t begin = 0;
        for (size_t end; (end = words_.find('\n', begin)) != words_.npos; begin = end + 1)
            take_line(std::string_view(words_).substr(begin, end - begin));
        words_.erase(0, begin);
    }

    void take_line(std::string_view line) {
        if (const auto start = showinfo_start(line)) {
            starts_.push_back(*start);
            return;
        }
        constexpr std::string_view error = "[error] ", fatal = "[fatal] ";
        for (const std::string_view level : {error, fatal})
            if (const size_t found = line.find(level); found != line.npos)
                complaint_ = line.substr(found + level.size());
    }

    ChildProcess child_;
    Extent extent_;
    std::string words_;
    std::deque<int64_t> starts_;
    std::string complaint_;
};

} // namespace

struct VideoFrames::State {
    std::filesystem::path path;
    VideoTimes times;
    std::optional<Decoder> decoder{};
    std::optional<TimedFrame> current{};
    std::optional<TimedFrame> ahead{};
    size_t current_index = 0; ///< the requested frame when `current` was set
    bool ended = false;

    Result<void> read_ahead();
    Result<void> start(size_t index);
    Result<void> advance_to(size_t index);
};

Result<void> VideoFrames::State::read_ahead() {
    Result<std::optional<TimedFrame>> frame = decoder->next();
    if (!frame)
        return cannot_read(path, frame.error().message);
    ahead = std::move(*frame);
    ended = !ahead.has_value();
    return {};
}

/// Sets `current` to a frame at or before the requested one.
Result<void> VideoFrames::State::start(size_t index) {
    current.reset();
    for (const size_t from : {index, size_t{0}}) {
        decoder.reset();
        Result<Decoder> fresh = Decoder::start(path, times, from);
        if (!fresh)
            return cannot_read(path, fresh.error().message);
        decoder.emplace(std::move(*fresh));
        if (Result<void> read = read_ahead(); !read)
            return read;
        current = std::exchange(ahead, {});
        // Some seeks end after their target; then decode from the start, which is before every frame.
        if (current && current->start <= times.starts[index])
            break;
    }
    if (current)
        return {};
    const std::string why = decoder->complaint();
    return cannot_read(path, why.empty() ? "ffmpeg finds no frame in it" : "ffmpeg says: " + why);
}

Result<void> VideoFrames::State::advance_to(size_t index) {
    const int64_t wanted = times.starts[index];
    const bool behind = current && (current->start <= wanted || (current_index == 0 && index == 0));
    if (!behind || (!ended && index > current_index + k_farthest_ahead))
        if (Result<void> started = start(index); !started)
            return started;
    current_index = index;
    // A frame that the file lists but the decoder skips is replaced by the previous one.
    while (current->start < wanted) {
        if (!ahead && !ended)
            if (Result<void> read = read_ahead(); !read)
                return read;
        if (!ahead || ahead->start > wanted)
            break;
        current = std::exchange(ahead, {});
    }
    return {};
}

Result<VideoFrames> VideoFrames::open(const std::filesystem::path& path) {
    if (const std::string why = why_unreadable(path); !why.empty())
        return cannot_read(path, why);
    const Result<std::string> text = output_of(video_times_arguments(path), {k_most_text}, k_get_ffmpeg);
    if (!text) {
        std::string why = text.error().message;
        const std::string prefix = "file:" + path.string() + ": ";
        if (why.starts_with(prefix))
            why = "it is no video that ffmpeg reads (" + why.substr(prefix.size()) + ")";
        return cannot_read(path, why);
    }
    auto times = parse_video_times(*text);
    if (!times)
        return cannot_read(path, times.error());
    if (!is_whole_video(path))
        return cannot_read(path, "the file is damaged or cut short");
    if (times->guessed)
        if (Result<void> replaced = replace_guessed_times(path, *times); !replaced)
            return cannot_read(path, replaced.error().message);
    return VideoFrames(std::make_unique<State>(State{path, std::move(*times)}));
}

VideoFrames::VideoFrames(std::unique_ptr<State> state) : state_(std::move(state)) {}
VideoFrames::VideoFrames(VideoFrames&&) noexcept = default;
VideoFrames& VideoFrames::operator=(VideoFrames&&) noexcept = default;
VideoFrames::~VideoFrames() = default;

Extent VideoFrames::extent() const {
    return state_->times.extent;
}

int VideoFrames::frame_count() const {
    return int(state_->times.starts.size());
}

double VideoFrames::duration() const {
    return state_->times.duration();
}

size_t VideoFrames::index_at(double seconds) const {
    return state_->times.frame_at(seconds);
}

Result<Image> VideoFrames::at(double seconds) {
    return state_->advance_to(index_at(seconds)).map([&] { return state_->current->image; });
}

} // namespace tidemark::image
