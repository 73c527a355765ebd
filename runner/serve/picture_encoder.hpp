// Encodes pictures for sending on a thread of its own, the newest first, so that drawing does not wait.
#pragma once

#include "image/image.hpp"
#include "serve/audience.hpp"
#include "serve/state_text.hpp"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace tidemark::serve {

class PictureEncoder {
public:
    struct Job {
        image::Image picture; ///< RGBA, 8 bits per channel
        PictureHead head;     ///< the number after its own is reserved for this picture too
    };
    /// Callbacks, all called on the encoder's thread.
    struct Settings {
        std::function<std::string(const image::Image&)> whole;          ///< returns a file
        std::function<std::string(const image::Image&, bool key)> film; ///< empty: encoding failed
        std::function<WantedCodings()> wanted;
        std::function<void(NumberedPicture)> done;
    };

    explicit PictureEncoder(Settings settings);
    PictureEncoder(const PictureEncoder&) = delete;
    PictureEncoder& operator=(const PictureEncoder&) = delete;
    ~PictureEncoder();

    /// Queues a picture; replaces one that is still waiting.
    void push(Job job);
    /// Returns whether no picture is waiting.
    bool has_room() const;

private:
    void run();
    NumberedPicture encoded(Job& job, const WantedCodings& wanted);

    Settings settings_;
    uint32_t film_ = 0; ///< number of the film's last picture
    Extent film_extent_{};
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<Job> waiting_;
    bool ending_ = false;
    std::thread thread_;
};

/// Returns one message: the head's length in four bytes, lowest first, the head as JSON, the file.
SharedMessage picture_message(const PictureHead& head, const std::string& file);

} // namespace tidemark::serve
