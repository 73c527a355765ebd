#include "window/sound_player.hpp"

#include "base/error.hpp"
#include "host/console.hpp"
#include "media/sound_device.hpp"
#include "render/sound_renderer.hpp"
#include "window/screen.hpp"

#include <algorithm>
#include <chrono>
#include <span>
#include <system_error>

namespace tidemark::cli {
namespace {

constexpr auto k_rate = int64_t(render::k_sample_rate);
/// Samples written to the device ahead of time: 0.25 s.
constexpr int64_t k_ahead = k_rate / 4;
/// Tolerated difference of sound and picture, which is not audible: 0.1 s. Beyond it the sound jumps.
constexpr int64_t k_unheard = k_rate / 10;
/// Interval between writes to the device.
constexpr std::chrono::milliseconds k_turn{20};
/// Rows drawn at a time: 0.19 s.
constexpr int k_rows_at_once = 16;

std::string text_to_play(const scene::Scene& scene, const scene::Pass& pass) {
    return scene.common.text() + pass.text.text();
}

} // namespace

/// A Sound pass and its audio device; used on the player's thread only.
class SoundPlayer::Voice {
public:
    Voice(platform::SharedContext context, render::SoundRenderer renderer, sound::Playback device)
        : context_(std::move(context)), renderer_(std::move(renderer)), device_(std::move(device)) {}

    /// Writes the next samples; `time` is iTime now.
    void keep_up(double time) {
        const auto now =
            int64_t(std::clamp(time, 0.0, render::SoundRenderer::k_longest_seconds) * double(k_rate));
        if (!speaking_ || next_ < now - k_unheard || next_ > now + k_ahead + k_unheard) {
            device_.silence();
            next_ = now;
            speaking_ = true;
        }
        while (next_ < now + k_ahead) {
            const auto taken = device_.write(samples_at(next_));
            if (!taken)
                next_ = now;
            if (!taken || *taken == 0)
                return;
            next_ += int64_t(*taken);
        }
    }

    bool speaking() const { return speaking_; }
    void pause() {
        device_.silence();
        speaking_ = false;
    }

private:
    /// Returns the samples from `first` to the end of the block that contains it.
    std::span<const int16_t> samples_at(int64_t first) {
        const int64_t begin = first - first % render::SoundRenderer::samples_in(k_rows_at_once);
        if (begin != drawn_from_) {
            drawn_ = renderer_.draw_rows(int(begin), k_rows_at_once);
            drawn_from_ = begin;
        }
        return std::span(drawn_).subspan(2 * size_t(first - begin));
    }

    platform::SharedContext context_;
    render::SoundRenderer renderer_;
    sound::Playback device_;
    std::vector<int16_t> drawn_;
    int64_t drawn_from_ = -1;
    int64_t next_ = 0; ///< next sample to write
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

void SoundPlayer::play(platform::SharedContext context, const scene::Scene& scene,
                       glsl::Precision precision) {
    const scene::Pass& pass = *scene.find(scene::PassKind::sound);
    const std::lock_guard lock(mutex_);
    if (playing_ == text_to_play(scene, pass))
        return;
    playing_ = text_to_play(scene, pass);
    order_.emplace(Order{std::move(context), scene, precision});
    try {
        if (!thread_.joinable())
            thread_ = std::thread([this] { run(); });
    } catch (const std::system_error& no_thread) {
        order_.reset();
        playing_.clear(); // the next call tries again
        say(std::string("no sound: cannot start a thread: ") + no_thread.what());
    }
    changed_.notify_all();
}

void SoundPlayer::stop() {
    const std::lock_guard lock(mutex_);
    playing_.clear();
    order_.reset();
    changed_.notify_all();
}

void SoundPlayer::follow(double time, bool running) {
    const std::lock_guard lock(mutex_);
    clock_ = {time, now_seconds(), running};
    changed_.notify_all();
}

bool SoundPlayer::busy() const {
    const std::lock_guard lock(mutex_);
    return busy_;
}

Result<SoundPlayer::Voice> SoundPlayer::begin(Order order) {
    auto device = TRY(sound::Playback::open(int(k_rate)));
    TRY(order.context.make_current());
    auto renderer = TRY(render::SoundRenderer::create(order.scene, render::local_date(), order.precision));
    (void)renderer.draw_rows(0, k_rows_at_once); // the driver finishes compiling at the first draw
    return Voice(std::move(order.context), std::move(renderer), std::move(device));
}

void SoundPlayer::run() {
    std::optional<Voice> voice;
    std::unique_lock lock(mutex_);
    while (!ending_) {
        if (order_) {
            Order order = *std::move(order_);
            order_.reset();
            busy_ = true;
            lock.unlock();
            voice.reset();
            auto begun = begin(std::move(order));
            if (begun)
                voice.emplace(*std::move(begun));
            else
                say("no sound: " + to_string(begun.error()));
            lock.lock();
            busy_ = false;
        } else if (voice && clock_.running && !playing_.empty()) {
            const Clock clock = clock_;
            lock.unlock();
            voice->keep_up(clock.time + now_seconds() - clock.at);
            lock.lock();
            if (clock_.running && !order_ && !ending_)
                changed_.wait_for(lock, k_turn);
        } else if (voice && voice->speaking()) {
            voice->pause();
        } else {
            changed_.wait(lock);
        }
    }
}

} // namespace tidemark::cli
