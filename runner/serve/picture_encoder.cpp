#include "serve/picture_encoder.hpp"

#include <chrono>
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
        Job job = *std::exchange(waiting_, std::nullopt);
        lock.unlock();
        const auto begun = std::chrono::steady_clock::now();
        const std::string file = encode_(job.picture);
        job.head.encode_ms =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count();
        done_({job.head.number, picture_message(job.head, file)});
        lock.lock();
    }
}

SharedMessage picture_message(const PictureHead& picture, const std::string& file) {
    const std::string head = to_text(picture);
    std::string bytes;
    bytes.reserve(4 + head.size() + file.size());
    for (int byte = 0; byte < 4; ++byte)
        bytes += char(head.size() >> (8 * byte) & 0xFF);
    return std::make_shared<Message>(Message{std::move(bytes) + head + file, true});
}

} // namespace tidemark::serve
