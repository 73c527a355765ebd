#include "serve/picture_encoder.hpp"

#include <utility>

namespace tidemark::serve {

PictureEncoder::PictureEncoder(Encode encode, Done done)
    : encode_(std::move(encode)), done_(std::move(done)), thread_([this] { run(); }) {}

PictureEncoder::~PictureEncoder() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
        changed_.notify_one();
    }
    thread_.join();
}

void PictureEncoder::push(Job job) {
    const std::lock_guard lock(mutex_);
    waiting_ = std::move(job);
    changed_.notify_one();
}

bool PictureEncoder::has_room() const {
    const std::lock_guard lock(mutex_);
    return !waiting_;
}

void PictureEncoder::run() {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [this] { return ending_ || waiting_; });
        if (ending_)
            return;
        const Job job = *std::exchange(waiting_, std::nullopt);
        lock.unlock();
        done_({job.number, picture_message(job.head, encode_(job.picture))});
        lock.lock();
    }
}

SharedMessage picture_message(const std::string& head, const std::string& file) {
    std::string bytes;
    bytes.reserve(4 + head.size() + file.size());
    for (int byte = 0; byte < 4; ++byte)
        bytes += char(head.size() >> (8 * byte) & 0xFF);
    return std::make_shared<Message>(Message{std::move(bytes) + head + file, true});
}

} // namespace tidemark::serve
