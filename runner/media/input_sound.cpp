// The sound of channels: audio tracks of videos, decoded by ffmpeg; two sides at one rate; loops; mixing.

#include "base/encoding.hpp"
#include "base/process.hpp"
#include "media/sound_file.hpp"
#include "media/spectrum.hpp"
#include "media/video_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>

namespace tidemark::sound {
namespace {

constexpr float k_full = 32768; ///< steps of 16 bits from 0 to full scale

tl::unexpected<Error> cannot_hear(const std::filesystem::path& path, std::string_view why) {
    return fail(ErrorCode::load, fmt::format("cannot read the sound of '{}': {}", path.string(), why));
}

/// Returns the number after ` name:` in a line.
template <class T>
std::optional<T> field_of(std::string_view line, std::string_view name) {
    const size_t at = line.find(fmt::format(" {}:", name));
    if (at == line.npos)
        return std::nullopt;
    std::string_view text = line.substr(at + name.size() + 2);
    T number{};
    return consume_number(text, number) ? std::optional(number) : std::nullopt;
}

/// Returns whether a video has an audio track.
Result<bool> has_audio(const std::filesystem::path& path) {
    constexpr size_t k_most_text = 1 << 16;
    std::vector<std::string> words{"ffprobe", "-v",      "error",         "-select_streams",  "a:0",
                                   "-of",     "compact", "-show_entries", "stream=codec_type"};
    for (std::string& word : image::video_input_arguments(path))
        words.push_back(std::move(word));
    const std::string text = TRY(output_of(words, {k_most_text}, image::k_get_ffmpeg));
    return text.find("codec_type=audio") != text.npos;
}

std::vector<std::string> decoder_words(const std::filesystem::path& path) {
    std::vector<std::string> words{"ffmpeg",    "-hide_banner", "-nostdin", "-nostats",
                                   "-loglevel", "level+info",   "-copyts"};
    for (std::string& word : image::video_input_arguments(path))
        words.push_back(std::move(word));
    for (const char* word : {"-map", "0:a:0", "-af", "asettb=1/sr,ashowinfo", "-f", "f32le", "pipe:1"})
        words.emplace_back(word);
    return words;
}

/// Decoded samples of all channels, interleaved, and the time of each block of them.
struct DecodedTrack {
    std::vector<float> samples;
    std::vector<ShownSamples> blocks;
};

/// Moves whole lines out of `words`; returns the last error among them.
std::string take_lines(std::string& words, std::vector<ShownSamples>& blocks) {
    std::string complaint;
    size_t begin = 0;
    for (size_t end; (end = words.find('\n', begin)) != words.npos; begin = end + 1) {
        const std::string_view line = std::string_view(words).substr(begin, end - begin);
        constexpr std::string_view k_error = "[error] ";
        if (const auto block = ashowinfo_samples(line))
            blocks.push_back(*block);
        else if (const size_t at = line.find(k_error); at != line.npos)
            complaint = line.substr(at + k_error.size());
    }
    words.erase(0, begin);
    return complaint;
}

/// Decodes a little more than the longest sound at most.
Result<DecodedTrack> decode(const std::filesystem::path& path) {
    auto child =
        TRY(ChildProcess::start(decoder_words(path), ChildProcess::Input::none, image::k_get_ffmpeg));
    DecodedTrack track;
    std::vector<float> block(size_t{1} << 16);
    std::string words, complaint;
    const auto take = [&] {
        if (std::string last = take_lines(words, track.blocks); !last.empty())
            complaint = std::move(last);
    };
    const auto is_too_long = [&] {
        const ShownSamples& first = track.blocks.front();
        return track.samples.size() > size_t(first.rate) * size_t(first.channels) * (k_longest_sound + 1);
    };
    for (size_t filled = 0;;) { // bytes in `block`
        const size_t count = TRY(child.read(std::as_writable_bytes(std::span(block)).subspan(filled), words));
        take();
        filled += count;
        const size_t whole = filled / sizeof(float);
        track.samples.insert(track.samples.end(), block.begin(), block.begin() + ptrdiff_t(whole));
        const size_t rest = filled - whole * sizeof(float);
        std::memmove(block.data(), block.data() + whole, rest);
        filled = rest;
        if (count == 0 || (!track.blocks.empty() && is_too_long()))
            break;
    }
    child.read_words(words);
    take();
    if (track.blocks.empty() || track.samples.empty())
        return cannot_hear(path, complaint.empty() ? "ffmpeg finds no sound in its audio track"
                                                   : "ffmpeg says: " + complaint);
    return track;
}

/// Puts silence where the times of the blocks leave gaps, as in a recording with pauses. Files that count
/// milliseconds round by less than the shortest gap.
std::vector<float> without_gaps(DecodedTrack track, size_t most_samples) {
    constexpr int k_shortest_gap = 50; // parts of a second
    const auto channels = size_t(track.blocks.front().channels);
    const int64_t tolerated = track.blocks.front().rate / k_shortest_gap;
    std::vector<float> whole;
    int64_t next = track.blocks.front().first;
    size_t decoded = 0, copied = 0; // samples of all channels
    const auto copy_until = [&](size_t end) {
        const auto begin = track.samples.begin();
        whole.insert(whole.end(), begin + ptrdiff_t(copied), begin + ptrdiff_t(end));
        copied = end;
    };
    for (const ShownSamples& block : track.blocks) {
        if (block.first - next > tolerated) {
            copy_until(std::min(decoded, track.samples.size()));
            whole.resize(whole.size() + std::min(size_t(block.first - next) * channels, most_samples));
            next = block.first;
        }
        next += int64_t(block.count);
        decoded += block.count * channels;
    }
    if (whole.empty())
        return std::move(track.samples);
    copy_until(track.samples.size());
    return whole;
}

/// Returns the weights of a channel in the left and the right output. Of 5.1 the centre and the
/// rear are 3 dB lower and the bass is left out, as browsers mix it; other layouts alternate.
std::pair<float, float> sides_of(size_t channel, size_t channels) {
    constexpr float k_half_power = 0.70710678F;
    if (channels == 1)
        return {1, 1};
    if (channels == 6 && channel >= 2)
        return channel == 2   ? std::pair(k_half_power, k_half_power)
               : channel == 3 ? std::pair(0.0F, 0.0F)
               : channel == 4 ? std::pair(k_half_power, 0.0F)
                              : std::pair(0.0F, k_half_power);
    if (channels == 6 || channels == 2)
        return channel == 0 ? std::pair(1.0F, 0.0F) : std::pair(0.0F, 1.0F);
    const float share = 1 / float((channels + (channel % 2 == 0 ? 1 : 0)) / 2);
    return channel % 2 == 0 ? std::pair(share, 0.0F) : std::pair(0.0F, share);
}

/// Returns the left and the right side at the file's rate.
std::array<std::vector<float>, 2> sides(const SoundData& sound) {
    const auto channels = size_t(sound.channels);
    std::array<std::vector<float>, 2> both{std::vector<float>(sound.frames()),
                                           std::vector<float>(sound.frames())};
    for (size_t channel = 0; channel < channels; ++channel) {
        const auto [left, right] = sides_of(channel, channels);
        for (size_t frame = 0; frame < sound.frames(); ++frame) {
            const float sample = sound.samples[frame * channels + channel];
            both[0][frame] += left * sample;
            both[1][frame] += right * sample;
        }
    }
    return both;
}

int16_t rounded(float value) {
    constexpr float k_lowest = std::numeric_limits<int16_t>::min();
    constexpr float k_highest = std::numeric_limits<int16_t>::max();
    return int16_t(std::lround(std::clamp(std::isnan(value) ? 0 : value, k_lowest, k_highest)));
}

float softened(float value) {
    constexpr float k_knee = 0.75F * k_full;
    constexpr float k_room = k_full - 1 - k_knee;
    const float size = std::abs(value);
    return size <= k_knee ? value
                          : std::copysign(k_knee + k_room * std::tanh((size - k_knee) / k_room), value);
}

} // namespace

std::optional<ShownSamples> ashowinfo_samples(std::string_view line) {
    if (!line.starts_with("[Parsed_ashowinfo"))
        return std::nullopt;
    const auto first = field_of<int64_t>(line, "pts");
    const auto rate = field_of<int>(line, "rate"), channels = field_of<int>(line, "channels");
    const auto count = field_of<size_t>(line, "nb_samples");
    if (!first || !rate || !channels || !count || *rate < 1 || *channels < 1)
        return std::nullopt;
    return ShownSamples{*first, *rate, *channels, *count};
}

Result<InputSound> read_music(const std::filesystem::path& path) {
    SoundData data = TRY(read_sound(path));
    const double loop = data.duration();
    return InputSound{std::move(data), 0, loop};
}

Result<std::optional<InputSound>> read_video_sound(const std::filesystem::path& path) {
    const auto video = TRY(image::VideoFrames::open(path));
    if (!TRY(has_audio(path)))
        return std::nullopt;
    DecodedTrack track = TRY(decode(path));
    const ShownSamples first = track.blocks.front();
    const size_t most = size_t(first.rate) * size_t(first.channels) * size_t{k_longest_sound};
    SoundData data{first.rate, first.channels, without_gaps(std::move(track), most)};
    if (data.samples.size() > most)
        return cannot_hear(path, fmt::format("it is longer than {} minutes", k_longest_sound / 60));
    const double start = double(first.first) / first.rate - video.start();
    return InputSound{std::move(data), start, video.duration()};
}

LoopedSound::LoopedSound(const InputSound& sound, int rate)
    : start_(std::llround(sound.start * rate)), loop_(std::max(1.0, sound.loop * rate)) {
    const auto most = size_t(std::max<int64_t>(0, std::llround(loop_) - start_)); // the rest is never played
    auto both = sides(sound.data);
    for (std::vector<float>& side : both)
        side = resampled(side, sound.data.rate, rate);
    samples_.resize(2 * std::min(most, both[0].size()));
    for (size_t i = 0; i < samples_.size(); ++i)
        samples_[i] = rounded(both[i % 2][i / 2] * k_full);
}

/// Returns the sample of the loop that is nearest to the time of a sample, at or after iTime 0.
int64_t LoopedSound::index_at(int64_t sample) const {
    const auto index = std::llround(std::fmod(double(sample), loop_));
    return index < std::llround(loop_) ? index : 0;
}

void LoopedSound::add(int64_t first, std::span<float> mix) const {
    const auto count = int64_t(mix.size() / 2), length = int64_t(std::llround(loop_));
    const auto known = int64_t(samples_.size() / 2);
    for (int64_t i = std::max<int64_t>(0, -first); i < count;) {
        const int64_t index = index_at(first + i);
        const int64_t run = std::min(count - i, length - index); // until the loop ends
        const int64_t from = std::max<int64_t>(0, start_ - index), to = std::min(run, known + start_ - index);
        for (int64_t at = 2 * from; at < 2 * to; ++at)
            mix[size_t(2 * i + at)] += samples_[size_t(2 * (index - start_) + at)];
        i += run;
    }
}

std::vector<int16_t> in_16_bits(std::span<const float> mix, bool several) {
    std::vector<int16_t> samples(mix.size());
    std::ranges::transform(mix, samples.begin(),
                           [several](float value) { return rounded(several ? softened(value) : value); });
    return samples;
}

int mixing_rate(std::span<const int> rates) {
    constexpr int k_lowest = 8000, k_highest = 96000, k_usual = 48000;
    const bool same =
        !rates.empty() && std::ranges::all_of(rates, [&](int rate) { return rate == rates[0]; });
    return same && rates[0] >= k_lowest && rates[0] <= k_highest ? rates[0] : k_usual;
}

std::string rate_words(int rate, int channels) {
    return fmt::format("{:g} kHz{}", rate / 1000.0,
                       channels == 1   ? " mono"
                       : channels == 2 ? " stereo"
                                       : fmt::format(", {} channels", channels));
}

} // namespace tidemark::sound
