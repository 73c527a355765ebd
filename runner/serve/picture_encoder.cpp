#include "serve/picture_encoder.hpp"

#include <utility>

namespace tidemark::serve {
namespace {

using Clock = std::chrono::steady_clock;

/// A film picture that stands still this long is sent again as a whole, sharp picture.
constexpr std::chrono::milliseconds k_still(200);

} // namespace

PictureEncoder::PictureEncoder(Settings settings)
    : settings_(std::move(settings)), thread_([this] { run(); }) {}

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
    std::optional<Job> soft; // sent only as film so far
    const auto is_asked = [this] { return ending_ || waiting_; };
    while (true) {
        if (soft)
            changed_.wait_for(lock, k_still, is_asked);
        else
            changed_.wait(lock, is_asked);
        if (ending_)
            return;
        const bool stands_still = !waiting_;
        Job job = *std::exchange(stands_still ? soft : waiting_, std::nullopt);
        lock.unlock();
        WantedCodings wanted{.whole = true};
        if (stands_still)
            ++job.head.number;
        else
            wanted = settings_.wanted();
        NumberedPicture picture = encoded(job, wanted);
        soft = !stands_still && picture.film ? std::optional(std::move(job)) : std::nullopt;
        settings_.done(std::move(picture));
        lock.lock();
    }
}

/// Without a film picture, makes a whole one even if no viewer needs it: a later viewer may.
NumberedPicture PictureEncoder::encoded(Job& job, const WantedCodings& wanted) {
    const auto begun = Clock::now();
    const Extent extent = job.picture.extent;
    const bool key = wanted.key || film_ == 0 || extent != film_extent_;
    const std::string film = wanted.film ? settings_.film(job.picture, key) : std::string();
    const std::string whole = wanted.whole || film.empty() ? settings_.whole(job.picture) : std::string();
    PictureHead& head = job.head;
    head.encode_ms = std::chrono::duration<double, std::milli>(Clock::now() - begun).count();
    NumberedPicture picture{head.number};
    head.coding = "jpeg";
    if (!whole.empty())
        picture.message = picture_message(head, whole);
    if (film.empty())
        return picture;
    head.coding = key ? "key" : "delta";
    picture.film = picture_message(head, film);
    picture.film_before = key ? 0 : film_;
    film_ = head.number;
    film_extent_ = extent;
    return picture;
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
