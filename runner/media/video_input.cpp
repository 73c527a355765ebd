#include "media/video_input.hpp"

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/process.hpp"
#include "media/picture_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace tidemark::image {
namespace {

constexpr size_t k_most_pixels = size_t{1} << 26;

std::optional<int64_t> number(std::string_view text) {
    const auto value = number_from<int64_t>(text);
    // A range of ticks in which sums and differences do not overflow.
    constexpr int64_t most = std::numeric_limits<int64_t>::max() / 4;
    return value && *value <= most && *value >= -most ? value : std::nullopt;
}

/// A line of the form "section|key=value|key=value…".
class Line {
public:
    explicit Line(std::string_view text) : text_(text) {}

    bool is(std::string_view section) const { return text_.substr(0, text_.find('|')) == section; }

    std::string_view operator[](std::string_view key) const {
        for (size_t at = text_.find('|'); at != text_.npos;) {
            const size_t end = text_.find('|', at + 1);
            const std::string_view field = text_.substr(at + 1, end - at - 1);
            if (field.size() > key.size() && field.starts_with(key) && field[key.size()] == '=')
                return field.substr(key.size() + 1);
            at = end;
        }
        return {};
    }

    std::optional<int64_t> number_at(std::string_view key) const { return number((*this)[key]); }

private:
    std::string_view text_;
};

struct Packet {
    int64_t start;
    int64_t duration;
};

void read_stream(const Line& line, VideoTimes& times) {
    times.extent = {int(std::clamp<int64_t>(line.number_at("width").value_or(0), 0, 1 << 20)),
                    int(std::clamp<int64_t>(line.number_at("height").value_or(0), 0, 1 << 20))};
    const std::string_view base = line["time_base"];
    const size_t slash = base.find('/');
    if (slash == base.npos)
        return;
    const auto numerator = number(base.substr(0, slash)), denominator = number(base.substr(slash + 1));
    if (numerator.value_or(0) > 0 && denominator.value_or(0) > 0)
        times.tick = double(*numerator) / double(*denominator);
}

/// Returns the end of the last frame, whose length is that in the file, or else that of the previous frame.
int64_t end_of(const std::vector<Packet>& packets) {
    const Packet& last = packets.back();
    int64_t duration = last.duration;
    if (duration <= 0 && packets.size() > 1)
        duration = last.start - packets[packets.size() - 2].start;
    return last.start + std::max<int64_t>(1, duration);
}

std::optional<std::string> objection(const VideoTimes& times, size_t packets) {
    if (times.extent.width < 1 || times.extent.height < 1 || times.tick <= 0.0 || packets == 0)
        return "there is no video in it";
    if (times.extent.width > k_largest_side || times.extent.height > k_largest_side ||
        times.extent.pixels() > k_most_pixels)
        return fmt::format("it is {}x{} pixels; the limit is {} on a side and 64 million in all",
                           times.extent.width, times.extent.height, k_largest_side);
    if (packets > size_t{k_most_video_frames})
        return fmt::format("it has more than {} frames", k_most_video_frames);
    return {};
}

} // namespace

tl::expected<VideoTimes, std::string> parse_video_times(std::string_view text) {
    VideoTimes times;
    std::vector<Packet> packets;
    bool turned = false;
    while (!text.empty()) {
        const size_t end = text.find('\n');
        const Line line(text.substr(0, end));
        text.remove_prefix(end == text.npos ? text.size() : end + 1);
        if (line.is("stream")) {
            read_stream(line, times);
        } else if (line.is("packet")) {
            auto start = line.number_at("pts");
            if (!start) {
                start = line.number_at("dts");
                times.guessed = true;
            }
            // D: a packet that must be decoded but not shown
            if (start && line["flags"].find('D') == std::string_view::npos)
                packets.push_back({*start, line.number_at("duration").value_or(0)});
        }
        const std::string_view rotation =
            line["side_data:rotation"].empty() ? line["rotation"] : line["side_data:rotation"];
        turned |= std::abs(number(rotation).value_or(0)) % 180 == 90;
    }
    if (const auto why = objection(times, packets.size()))
        return tl::unexpected<std::string>(*why);
    if (turned) // ffmpeg rotates the picture, as players do
        std::swap(times.extent.width, times.extent.height);
    std::sort(packets.begin(), packets.end(),
              [](const Packet& a, const Packet& b) { return a.start < b.start; });
    times.end = end_of(packets);
    for (const Packet& packet : packets)
        if (times.starts.empty() || packet.start > times.starts.back())
            times.starts.push_back(packet.start);
    return times;
}

std::optional<int64_t> showinfo_start(std::string_view line) {
    // "[Parsed_showinfo_3 @ 0x…] [info] n:   7 pts:   3584 pts_time:…"
    constexpr std::string_view mark = " pts:";
    const size_t at = line.find(mark);
    if (!line.starts_with("[Parsed_showinfo") || line.find("] n:") == line.npos || at == line.npos)
        return {};
    const std::string_view after = line.substr(at + mark.size());
    const std::string_view digits = after.substr(std::min(after.find_first_not_of(' '), after.size()));
    return number(digits.substr(0, digits.find(' ')));
}

void set_starts(VideoTimes& times, std::vector<int64_t> starts) {
    std::sort(starts.begin(), starts.end());
    starts.erase(std::unique(starts.begin(), starts.end()), starts.end());
    if (starts.empty())
        return;
    const int64_t last = times.end - times.starts.back();
    times.starts = std::move(starts);
    times.end = times.starts.back() + last;
    times.guessed = false;
}

size_t VideoTimes::frame_at(double seconds) const {
    const double length = duration();
    double time = std::isfinite(seconds) ? std::fmod(seconds, length) : 0.0;
    if (time < 0.0)
        time += length;
    const double early = std::min(0.5 * tick, 0.0005);
    const auto after = std::partition_point(starts.begin(), starts.end(), [&](int64_t start) {
        return double(start - starts.front()) * tick <= time + early;
    });
    // The last half millisecond belongs to the next loop.
    if (time + early >= length)
        return 0;
    return size_t(std::max<ptrdiff_t>(1, after - starts.begin())) - 1;
}

std::vector<std::string> video_input_arguments(const std::filesystem::path& path) {
    return {"-protocol_whitelist",
            "file",
            "-format_whitelist",
            "matroska,webm,mov,mp4,ogg,avi,flv,mpeg,mpegts,asf,gif,apng,ivf,nut,yuv4mpegpipe",
            "-i",
            "file:" + path.string()};
}

std::vector<std::string> video_times_arguments(const std::filesystem::path& path) {
    std::vector<std::string> arguments = {
        "ffprobe",
        "-v",
        "error",
        "-select_streams",
        "V:0",
        "-of",
        "compact",
        "-show_entries",
        "packet=pts,dts,duration,flags:stream=width,height,time_base:stream_side_data=rotation"};
    for (std::string& argument : video_input_arguments(path))
        arguments.push_back(std::move(argument));
    return arguments;
}

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
            return fail(ErrorCode::load, "ffmpeg gave a frame without a time; ffmpeg 5.1 or later is needed");
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
            why = "ffmpeg cannot read it as a video (" + why.substr(prefix.size()) + ")";
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

double VideoFrames::start() const {
    return double(state_->times.starts.front()) * state_->times.tick;
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

namespace {

std::vector<std::string> input_arguments(const std::filesystem::path& path) {
    std::error_code ignored;
    if (std::filesystem::is_character_file(path, ignored))
        return {"-f", "v4l2", "-i", path.string()};
    std::vector<std::string> arguments = {"-re", "-stream_loop", "-1"};
    for (std::string& argument : video_input_arguments(path))
        arguments.push_back(std::move(argument));
    return arguments;
}

std::vector<std::string> camera_arguments(const std::filesystem::path& path) {
    std::vector<std::string> arguments = {"ffmpeg",   "-hide_banner", "-nostdin",
                                          "-nostats", "-loglevel",    "error"};
    for (std::string& argument : input_arguments(path))
        arguments.push_back(std::move(argument));
    const std::string filters =
        fmt::format("scale={0}:{1}:force_original_aspect_ratio=increase,crop={0}:{1},format=rgba,vflip",
                    k_camera_extent.width, k_camera_extent.height);
    for (const char* argument :
         {"-map", "0:V:0", "-vf", filters.c_str(), "-fps_mode", "passthrough", "-f", "rawvideo", "pipe:1"})
        arguments.emplace_back(argument);
    return arguments;
}

tl::unexpected<Error> cannot_see(const std::filesystem::path& path, std::string_view why) {
    return fail(ErrorCode::load, fmt::format("cannot read the webcam or video '{}': {}", path.string(), why));
}

} // namespace

class Camera::Feed {
public:
    explicit Feed(ChildProcess child) : child_(std::move(child)) {}
    Feed(const Feed&) = delete;
    Feed& operator=(const Feed&) = delete;
    ~Feed() {
        child_.stop();
        if (thread_.joinable())
            thread_.join();
    }

    void start() {
        thread_ = std::thread([this] {
            while (take_picture()) {
            }
        });
    }

    /// Waits for the next picture; returns false when there are no more.
    bool take_picture() {
        auto picture = std::make_shared<Image>(k_camera_extent, 4, SampleType::u8);
        for (size_t filled = 0; filled < picture->bytes.size();) {
            words_.clear(); // limits the stored messages
            const Result<size_t> count = child_.read(std::span(picture->bytes).subspan(filled), words_);
            if (!count || *count == 0)
                return false;
            filled += *count;
        }
        const std::lock_guard lock(mutex_);
        newest_ = std::move(picture);
        return true;
    }

    std::shared_ptr<const Image> newest() const {
        const std::lock_guard lock(mutex_);
        return newest_;
    }

    /// Returns the last line that ffmpeg printed on stderr.
    std::string_view complaint() const {
        const std::string_view text = std::string_view(words_).substr(0, words_.find_last_not_of('\n') + 1);
        return text.substr(text.rfind('\n') + 1);
    }

private:
    ChildProcess child_;
    std::string words_;
    mutable std::mutex mutex_;
    std::shared_ptr<const Image> newest_; ///< guarded by the mutex
    std::thread thread_;
};

Camera::Camera(std::unique_ptr<Feed> feed) : feed_(std::move(feed)) {}
Camera::Camera(Camera&&) noexcept = default;
Camera& Camera::operator=(Camera&&) noexcept = default;
Camera::~Camera() = default;

Result<Camera> Camera::open(const std::filesystem::path& path) {
    auto feed = std::make_unique<Feed>(
        TRY(ChildProcess::start(camera_arguments(path), ChildProcess::Input::none, k_get_ffmpeg)));
    if (!feed->take_picture())
        return cannot_see(path, feed->complaint().empty() ? "ffmpeg gives no picture" : feed->complaint());
    feed->start();
    return Camera(std::move(feed));
}

std::shared_ptr<const Image> Camera::newest() const {
    return feed_->newest();
}

} // namespace tidemark::image
