// Encodes frames on worker threads while the next ones are drawn. Frames wait in a queue of bounded length,
// so that memory stays bounded too.
#pragma once

#include "base/result.hpp"
#include "image/files/picture_file.hpp"
#include "image/image.hpp"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace tidemark::cli {

struct FrameFile {
    int frame = 0;
    OutputPath output;
    image::Image image;
    image::PictureFormat format;
    std::vector<image::PictureLayer> layers{}; ///< instead of the picture, where the file has several
};

class FrameWriter {
public:
    /// `waiting`: frames at most that no worker has in hand yet.
    FrameWriter(unsigned workers, unsigned waiting);
    explicit FrameWriter(unsigned workers) : FrameWriter(workers, workers + 1) {}
    ~FrameWriter();
    FrameWriter(const FrameWriter&) = delete;
    FrameWriter& operator=(const FrameWriter&) = delete;

    /// Hands a frame over; waits while the queue is full. False once a frame could not be written: the rest
    /// need not be drawn.
    bool push(FrameFile frame);

    /// Waits until all that was handed over is written; false once a frame could not be.
    bool drain();

    /// Pictures that are on disk by now.
    size_t written();

    /// Waits for all frames; the error of the earliest one that failed.
    Result<void> finish();

private:
    void work();
    /// Without the lock meanwhile.
    void write(const FrameFile& frame, std::unique_lock<std::mutex>& lock);

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<FrameFile> queue_;
    size_t capacity_;
    size_t written_ = 0;
    size_t writing_ = 0; ///< frames that workers have in hand
    bool closed_ = false;
    std::vector<std::pair<int, Error>> errors_;
    std::vector<std::thread> workers_;
};

} // namespace tidemark::cli
