// Makes files of pictures on a thread of its own, the newest first: whoever draws does not wait.
#pragma once

#include "image/image.hpp"
#include "serve/audience.hpp"
#include "serve/state_text.hpp"

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
        PictureHead head;
    };
    using Encode = std::function<std::string(const image::Image&)>;
    using Done = std::function<void(NumberedPicture)>;

    /// Both are called on the encoder's thread.
    PictureEncoder(Encode encode, Done done);
    PictureEncoder(const PictureEncoder&) = delete;
    PictureEncoder& operator=(const PictureEncoder&) = delete;
    ~PictureEncoder();

    /// One that was not begun is left out.
    void push(Job job);
    /// None waits.
    bool has_room() const;

private:
    void run();

    Encode encode_;
    Done done_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<Job> waiting_;
    bool ending_ = false;
    std::thread thread_;
};

/// One message: the head's length in four bytes, the lowest first, the head as JSON, the file.
SharedMessage picture_message(const PictureHead& head, const std::string& file);

} // namespace tidemark::serve
