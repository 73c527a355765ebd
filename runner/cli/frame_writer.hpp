// Encodes frames on worker threads while the next ones are drawn. The queue of waiting frames is bounded, and
// so is the memory for it.
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
    std::vector<image::PictureLayer> layers{}; ///< written instead of `image`, for a file with several layers
};

class FrameWriter {
public:
    /// `waiting`: the largest number of frames that no worker has taken yet.
    FrameWriter(unsigned workers, unsigned waiting);
    explicit FrameWriter(unsigned workers) : FrameWriter(workers, workers + 1) {}
    ~FrameWriter();
    FrameWriter(const FrameWriter&) = delete;
    FrameWriter& operator=(const FrameWriter&) = delete;

    /// Queues a frame; waits while the queue is full. Returns false once a frame could not be written: the
    /// remaining ones need not be drawn.
    bool push(FrameFile frame);

    /// Waits until all queued frames are written; returns false once one could not be.
    bool drain();

    /// Returns the number of pictures written so far.
    size_t written();

    /// Waits for all frames; returns the error of the earliest frame that failed.
    Result<void> finish();

private:
    void work();
    /// Writes a frame with the lock released.
    void write(const FrameFile& frame, std::unique_lock<std::mutex>& lock);

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<FrameFile> queue_;
    size_t capacity_;
    size_t written_ = 0;
    size_t writing_ = 0; ///< frames that workers are writing
    bool closed_ = false;
    std::vector<std::pair<int, Error>> errors_;
    std::vector<std::thread> workers_;
};

} // namespace tidemark::cli
