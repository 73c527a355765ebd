#include "cli/frame_writer.hpp"

#include <algorithm>
#include <new>
#include <system_error>

namespace tidemark::cli {

FrameWriter::FrameWriter(unsigned workers, unsigned waiting) : capacity_(waiting) {
    try {
        for (unsigned i = 0; i < workers; ++i)
            workers_.emplace_back([this] { work(); });
    } catch (const std::system_error&) {
        // At the system's thread limit, the threads started so far do the work, or else `push` itself.
    }
}

FrameWriter::~FrameWriter() {
    (void)finish();
}

bool FrameWriter::push(FrameFile frame) {
    std::unique_lock lock(mutex_);
    if (workers_.empty()) {
        write(frame, lock);
        return errors_.empty();
    }
    changed_.wait(lock, [&] { return queue_.size() < capacity_ || !errors_.empty(); });
    if (!errors_.empty())
        return false;
    queue_.push_back(std::move(frame));
    changed_.notify_all();
    return true;
}

bool FrameWriter::drain() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return (queue_.empty() && writing_ == 0) || !errors_.empty(); });
    return errors_.empty();
}

size_t FrameWriter::written() {
    const std::lock_guard lock(mutex_);
    return written_;
}

Result<void> FrameWriter::finish() {
    {
        const std::lock_guard lock(mutex_);
        closed_ = true;
        changed_.notify_all();
    }
    for (std::thread& worker : workers_)
        worker.join();
    workers_.clear();
    if (errors_.empty())
        return {};
    return fail(std::min_element(errors_.begin(), errors_.end(), [](const auto& a, const auto& b) {
                    return a.first < b.first;
                })->second);
}

void FrameWriter::work() {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [&] { return !queue_.empty() || closed_; });
        if (queue_.empty())
            return;
        const FrameFile frame = std::move(queue_.front());
        queue_.pop_front();
        changed_.notify_all();
        write(frame, lock);
    }
}

void FrameWriter::write(const FrameFile& frame, std::unique_lock<std::mutex>& lock) {
    ++writing_;
    lock.unlock();
    Result<void> written;
    try {
        written = frame.layers.empty() ? image::write_picture(frame.output, frame.image, frame.format)
                                       : image::write_layers(frame.output, frame.layers);
    } catch (const std::bad_alloc&) {
        written =
            fail(ErrorCode::write, "cannot write '" + frame.output.path().string() + "': out of memory");
    }
    lock.lock();
    --writing_;
    if (written)
        ++written_;
    else
        errors_.emplace_back(frame.frame, std::move(written.error()));
    changed_.notify_all();
}

} // namespace tidemark::cli
