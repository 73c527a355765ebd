#include "image/files/video_times.hpp"

#include "image/files/picture_file.hpp"
#include "image/files/video_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

namespace tidemark::image {
namespace {

constexpr size_t k_most_pixels = size_t{1} << 26;

std::optional<int64_t> number(std::string_view text) {
    int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    // A range of ticks in which sums and differences do not overflow.
    constexpr int64_t most = std::numeric_limits<int64_t>::max() / 4;
    if (error != std::errc() || end != text.data() + text.size() || value > most || value < -most)
        return {};
    return value;
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

} // namespace tidemark::image
