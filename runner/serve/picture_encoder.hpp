// Makes what is sent of pictures on a thread of its own, the newest first: whoever draws does not wait.
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
        image::Image picture; ///< RGBA in bytes
        PictureHead head;     ///< the number after its own is this one's, too
    };
    /// All are called on the encoder's thread.
    struct Settings {
        std::function<std::string(const image::Image&)> whole;          ///< a file
        std::function<std::string(const image::Image&, bool key)> film; ///< empty: it failed
        std::function<WantedCodings()> wanted;
        std::function<void(NumberedPicture)> done;
    };

    explicit PictureEncoder(Settings settings);
    PictureEncoder(const PictureEncoder&) = delete;
    PictureEncoder& operator=(const PictureEncoder&) = delete;
    ~PictureEncoder();

    /// One that was not begun is left out.
    void push(Job job);
    /// None waits.
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

/// One message: the head's length in four bytes, the lowest first, the head as JSON, the file.
SharedMessage picture_message(const PictureHead& head, const std::string& file);

} // namespace tidemark::serve
