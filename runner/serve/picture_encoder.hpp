// Makes files of pictures on a thread of its own, the newest first: whoever draws does not wait.
#pragma once

#include "image/image.hpp"
#include "serve/audience.hpp"

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace tidemark::serve {

class PictureEncoder {
public:
    /// A picture of RGBA in bytes with what stands before it in its message.
    struct Job {
        image::Image picture;
        uint32_t number = 0;
        std::string head; ///< JSON
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

/// A head and a file as one message: the head's length in four bytes, the lowest first, the head, the file.
SharedMessage picture_message(const std::string& head, const std::string& file);

} // namespace tidemark::serve
