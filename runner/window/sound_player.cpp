#include "window/sound_player.hpp"

#include "base/error.hpp"
#include "host/console.hpp"
#include "media/sound_device.hpp"
#include "window/screen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <span>
#include <system_error>

namespace tidemark::window {

using namespace host;
namespace {

constexpr auto k_rate = int64_t(render::k_sample_rate);
/// Samples written to the device ahead of time: 0.25 s.
constexpr int64_t k_ahead = k_rate / 4;
/// Tolerated difference of sound and picture, which is not audible: 0.1 s. Beyond it the sound jumps.
constexpr int64_t k_unheard = k_rate / 10;
constexpr double k_unheard_seconds = 0.1;
/// Change of the volume within one sample, so that it does not click: full scale takes 0.02 s.
constexpr float k_gain_step = 1 / (0.02F * float(k_rate));
/// Interval between writes to the device.
constexpr std::chrono::milliseconds k_turn{20};
/// Rows drawn at a time: 0.19 s.
constexpr int k_rows_at_once = 16;

std::string text_to_play(const scene::Scene& scene) {
    const scene::Pass* const pass = scene.find(scene::PassKind::sound);
    return pass ? scene.common.text() + pass->text.text() : std::string();
}

/// A Sound pass that is ready to draw, on the thread where its context is current.
struct PlayedPass {
    host::SharedContext context;
    render::SoundRenderer renderer;
};

Result<PlayedPass> ready_pass(host::SharedContext context, const scene::Scene& scene,
                              glsl::Precision precision) {
    TRY(context.make_current());
    auto renderer = TRY(render::SoundRenderer::create(scene, render::local_date(), precision));
    (void)renderer.draw_rows(0, k_rows_at_once); // the driver finishes compiling at the first draw
    return PlayedPass{std::move(context), std::move(renderer)};
}

/// Returns the error for the middle of a line, without the program's name.
std::string without_program(Error error) {
    std::string text = std::exchange(error.message, "");
    const std::string places = to_string(error);
    return text + (text.empty() || places.empty() ? "" : "\n") + places;
}

} // namespace

/// The mix of all playing sounds, and its audio device; used on the player's thread only.
class SoundPlayer::Voice {
public:
    /// Writes the next samples at a volume; `time` is iTime now, `jumped`: not by running.
    void keep_up(double time, bool jumped, float gain) {
        const auto now =
            int64_t(std::clamp(time, 0.0, render::SoundRenderer::k_longest_seconds) * double(k_rate));
        if (!speaking_ || jumped || next_ < now - k_unheard || next_ > now + k_ahead + k_unheard) {
            device_->silence();
            next_ = now;
            gain_ = gain;
            speaking_ = true;
        }
        while (next_ < now + k_ahead) {
            std::span<const int16_t> samples = samples_at(next_);
            samples = samples.first(std::min(samples.size(), 2 * size_t(now + k_ahead - next_)));
            const auto taken = device_->write(at_volume(samples, gain));
            if (!taken)
                next_ = now;
            if (!taken || *taken == 0)
                return;
            next_ += int64_t(*taken);
            gain_ = gain_after(int64_t(*taken), gain);
        }
    }

    bool speaking() const { return speaking_; }
    /// Stops at once.
    void pause() {
        device_->silence();
        speaking_ = false;
    }

    bool has_device() const { return device_.has_value(); }
    /// Returns whether the device has not failed for that reason before.
    bool fails_anew(const std::string& reason) { return std::exchange(problem_, reason) != reason; }
    void set_device(sound::Playback device) { device_.emplace(std::move(device)); }
    bool has_sound() const { return pass_ || !inputs_.empty(); }
    bool can_play() const { return device_ && has_sound(); }
    void set_inputs(std::vector<sound::LoopedSound> inputs) {
        inputs_ = std::move(inputs);
        mixed_from_ = -1;
    }
    void drop_pass() {
        pass_.reset(); // while its context is current
        mixed_from_ = -1;
    }
    void set_pass(PlayedPass pass) { pass_.emplace(std::move(pass)); }

private:
    /// Returns the samples from `first` to the end of the block that contains it.
    std::span<const int16_t> samples_at(int64_t first) {
        const int64_t count = render::SoundRenderer::samples_in(k_rows_at_once);
        const int64_t begin = first - first % count;
        if (begin != mixed_from_) {
            mix(begin, size_t(count));
            mixed_from_ = begin;
        }
        return std::span(mixed_).subspan(2 * size_t(first - begin));
    }

    void mix(int64_t begin, size_t count) {
        std::vector<float> sum(2 * count);
        if (pass_)
            std::ranges::copy(pass_->renderer.draw_rows(int(begin), k_rows_at_once), sum.begin());
        for (const sound::LoopedSound& input : inputs_)
            input.add(begin, sum);
        mixed_ = sound::in_16_bits(sum, inputs_.size() + (pass_ ? 1 : 0) > 1);
    }

    /// Returns the volume after so many samples on its way to `wanted`.
    float gain_after(int64_t samples, float wanted) const {
        const float most = float(samples) * k_gain_step;
        return gain_ + std::clamp(wanted - gain_, -most, most);
    }

    std::span<const int16_t> at_volume(std::span<const int16_t> samples, float wanted) {
        if (gain_ == 1 && wanted == 1)
            return samples;
        quieter_.resize(samples.size());
        for (size_t i = 0; i < samples.size(); ++i)
            quieter_[i] = int16_t(std::lround(gain_after(int64_t(i / 2), wanted) * float(samples[i])));
        return quieter_;
    }

    std::optional<PlayedPass> pass_;
    std::vector<sound::LoopedSound> inputs_;
    std::optional<sound::Playback> device_;
    std::string problem_; ///< why it could not be opened
    std::vector<int16_t> mixed_;
    std::vector<int16_t> quieter_;
    int64_t mixed_from_ = -1;
    int64_t next_ = 0; ///< next sample to write
    float gain_ = 1;
    bool speaking_ = false;
};

SoundPlayer::~SoundPlayer() {
    if (!thread_.joinable())
        return;
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
        changed_.notify_all();
    }
    thread_.join();
}

std::vector<SoundPlayer::Input> SoundPlayer::inputs_of(const scene::Scene& scene) {
    std::vector<Input> inputs;
    for (render::HeardChannel& channel : render::heard_channels(scene)) {
        std::error_code ignored;
        const auto written = std::filesystem::last_write_time(channel.file, ignored);
        inputs.push_back({std::move(channel), written});
    }
    return inputs;
}

void SoundPlayer::play(const MakeContext& make_context, const scene::Scene& scene,
                       glsl::Precision precision) {
    Order order;
    if (std::vector<Input> inputs = inputs_of(scene); inputs != inputs_)
        order.inputs = inputs_ = std::move(inputs);
    if (std::string text = text_to_play(scene); text != pass_) {
        order.pass.emplace(Order::Pass{{}, scene, precision});
        pass_ = std::move(text);
    }
    if (!order.pass && !order.inputs)
        return;
    if (!pass_.empty() && order.pass) {
        auto context = make_context();
        if (context)
            order.pass->context.emplace(*std::move(context));
        else
            say(to_string(context.error()));
    }
    const std::lock_guard lock(mutex_);
    if (order_ && !order.pass)
        order.pass = std::move(order_->pass);
    if (order_ && !order.inputs)
        order.inputs = std::move(order_->inputs);
    order_ = std::move(order);
    start_thread();
    changed_.notify_all();
}

void SoundPlayer::start_thread() {
    try {
        if (!thread_.joinable())
            thread_ = std::thread([this] { run(); });
    } catch (const std::system_error& no_thread) {
        order_.reset(); // the next call tries again
        pass_.clear();
        inputs_.clear();
        say(std::string("no sound: cannot start a thread: ") + no_thread.what());
    }
}

void SoundPlayer::follow(double time, double now, bool running) {
    const std::lock_guard lock(mutex_);
    const bool jumped = clock_.jumped || std::abs(time - clock_.time_at(now)) > k_unheard_seconds;
    clock_ = {time, now, running, jumped};
    changed_.notify_all();
}

void SoundPlayer::set_volume(double volume) {
    const std::lock_guard lock(mutex_);
    gain_ = float(volume);
    changed_.notify_all();
}

bool SoundPlayer::busy() const {
    const std::lock_guard lock(mutex_);
    return busy_;
}

/// Reads the files, opens the device if there is something to play, and compiles the pass.
void SoundPlayer::load(Order order, Voice& voice) {
    if (order.inputs) {
        std::vector<sound::LoopedSound> sounds;
        for (const Input& input : *order.inputs)
            if (const auto sound = render::read_sound_of(input.channel); !sound)
                say(fmt::format("no sound of {}: {}", input.channel.name, without_program(sound.error())));
            else if (*sound)
                sounds.emplace_back(**sound, int(k_rate));
        voice.set_inputs(std::move(sounds));
    }
    if (order.pass)
        voice.drop_pass();
    const bool has_pass = order.pass && order.pass->context;
    if (!voice.has_device() && (has_pass || voice.has_sound())) {
        auto device = sound::Playback::open(int(k_rate));
        if (const std::string problem = device ? "" : without_program(device.error()); !device) {
            if (voice.fails_anew(problem))
                say("no sound: " + problem);
            return;
        }
        voice.set_device(*std::move(device));
    }
    if (!has_pass)
        return;
    auto pass = ready_pass(*std::move(order.pass->context), order.pass->scene, order.pass->precision);
    if (pass)
        voice.set_pass(*std::move(pass));
    else
        say("no sound: " + without_program(pass.error()));
}

void SoundPlayer::run() {
    Voice voice;
    std::unique_lock lock(mutex_);
    while (!ending_) {
        if (order_) {
            Order order = *std::move(order_);
            order_.reset();
            busy_ = true;
            lock.unlock();
            load(std::move(order), voice);
            lock.lock();
            busy_ = false;
        } else if (voice.can_play() && clock_.running && gain_ > 0) {
            const double time = clock_.time_at(now_seconds());
            const bool jumped = std::exchange(clock_.jumped, false);
            const float gain = gain_;
            lock.unlock();
            voice.keep_up(time, jumped, gain);
            lock.lock();
            if (clock_.running && !order_ && !ending_)
                changed_.wait_for(lock, k_turn);
        } else if (voice.speaking()) {
            voice.pause();
        } else {
            changed_.wait(lock);
        }
    }
}

} // namespace tidemark::window
