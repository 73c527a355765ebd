// Plays the Sound pass of a scene in step with a clock, on a thread with an OpenGL context of its own:
// neither waits for the picture, nor the picture for it.
#pragma once

#include "base/result.hpp"
#include "glsl/dialect.hpp"
#include "platform/shared_context.hpp"
#include "scene/scene.hpp"

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

    /// From now on the Sound pass of `scene`, unless it is the one that plays already.
    void play(platform::SharedContext context, const scene::Scene& scene, glsl::Precision precision);
    /// There is nothing to hear.
    void stop();
    /// What iTime is at the moment, and whether it runs.
    void follow(double time, bool running);

    /// The driver is compiling for it, perhaps for long.
    bool busy() const;

private:
    struct Order {
        platform::SharedContext context;
        scene::Scene scene;
        glsl::Precision precision;
    };
    struct Clock {
        double time = 0; ///< iTime
        double at = 0;   ///< when it was that, wall clock
        bool running = false;
    };
    class Voice;

    void run();
    static Result<Voice> begin(Order order);

    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<Order> order_; ///< not yet begun
    std::string playing_;        ///< the text that was ordered last; empty: none
    Clock clock_;
    bool busy_ = false;
    bool ending_ = false;
    std::thread thread_; ///< begun by the first order
};

} // namespace tidemark::cli
