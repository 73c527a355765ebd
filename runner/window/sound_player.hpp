// Plays the sound of a scene in step with a clock: its Sound pass and the channels that read sound files or
// videos. Works on a thread with an OpenGL context of its own. Sound and picture do not wait for each other.
#pragma once

#include "base/error.hpp"
#include "host/gl_context.hpp"
#include "render/sound_renderer.hpp"
#include "scene/scene.hpp"
#include "shader/shader_source.hpp"

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace tidemark::window {

class SoundPlayer {
public:
    using MakeContext = std::function<Result<host::SharedContext>()>;

    SoundPlayer() = default;
    SoundPlayer(const SoundPlayer&) = delete;
    SoundPlayer& operator=(const SoundPlayer&) = delete;
    /// Waits for the thread: see `busy`.
    ~SoundPlayer();

    /// Plays the sound of `scene` from now on; unchanged parts continue. Calls `make_context` for a new
    /// Sound pass. Prints a line if something cannot be played.
    void play(const MakeContext& make_context, const scene::Scene& scene, glsl::Precision precision);
    /// Sets iTime at the moment `now`, and whether it runs at its usual speed; other speeds are silent.
    void follow(double time, double now, bool running);
    /// Sets the volume, 0 to 1. At 0 nothing is drawn or mixed.
    void set_volume(double volume);

    /// Returns whether the scene has something to play.
    bool plays() const { return !pass_.empty() || !inputs_.empty(); }
    /// Returns whether the driver is compiling the pass or a file is being read, which may take long.
    bool busy() const;

private:
    /// A channel's file as it is on disk.
    struct Input {
        render::HeardChannel channel;
        std::filesystem::file_time_type written;

        bool operator==(const Input& other) const {
            return channel.file == other.channel.file && written == other.written;
        }
    };
    /// The sounds to load. A missing value stays as it is.
    struct Order {
        struct Pass {
            std::optional<host::SharedContext> context; ///< none: the scene has no Sound pass
            scene::Scene scene;
            glsl::Precision precision;
        };
        std::optional<Pass> pass{};
        std::optional<std::vector<Input>> inputs{};
    };
    struct Clock {
        double time = 0; ///< iTime
        double at = 0;   ///< when it had that value, by now_seconds
        bool running = false;
        bool jumped = false; ///< not by running, since the last samples

        double time_at(double now) const { return running ? time + now - at : time; }
    };
    class Voice;

    static std::vector<Input> inputs_of(const scene::Scene& scene);
    void start_thread();
    void run();
    static void load(Order order, Voice& voice);

    std::string pass_;          ///< the text of the pass that plays or is loading; empty: none
    std::vector<Input> inputs_; ///< that play or are loading
    mutable std::mutex mutex_;  ///< guards the rest
    std::condition_variable changed_;
    std::optional<Order> order_; ///< not started yet
    Clock clock_;
    float gain_ = 1; ///< 0: nothing is played
    bool busy_ = false;
    bool ending_ = false;
    std::thread thread_; ///< started by the first order
};

} // namespace tidemark::window
