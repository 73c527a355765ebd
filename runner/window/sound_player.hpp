// Plays the Sound pass of a scene in step with a clock, on a thread with an OpenGL context of its own. Sound
// and picture do not wait for each other.
#pragma once

#include "base/error.hpp"
#include "host/gl_context.hpp"
#include "scene/scene.hpp"
#include "shader/shader_source.hpp"

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace tidemark::cli {

class SoundPlayer {
public:
    SoundPlayer() = default;
    SoundPlayer(const SoundPlayer&) = delete;
    SoundPlayer& operator=(const SoundPlayer&) = delete;
    /// Waits for the thread: see `busy`.
    ~SoundPlayer();

    /// Starts to play the Sound pass of `scene`, unless the same text is playing already.
    void play(platform::SharedContext context, const scene::Scene& scene, glsl::Precision precision);
    /// Stops playing.
    void stop();
    /// Sets iTime at the moment, and whether it runs.
    void follow(double time, bool running);

    /// Returns whether the driver is compiling the pass, which may take long.
    bool busy() const;

private:
    struct Order {
        platform::SharedContext context;
        scene::Scene scene;
        glsl::Precision precision;
    };
    struct Clock {
        double time = 0; ///< iTime
        double at = 0;   ///< when it had that value, by now_seconds
        bool running = false;
    };
    class Voice;

    void run();
    static Result<Voice> begin(Order order);

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<Order> order_; ///< not started yet
    std::string playing_;        ///< the text of the last order; empty: none
    Clock clock_;
    bool busy_ = false;
    bool ending_ = false;
    std::thread thread_; ///< started by the first order
};

} // namespace tidemark::cli
