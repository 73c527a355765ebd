#include "image/files/camera.hpp"

#include "base/child_process.hpp"
#include "base/try.hpp"
#include "image/files/video_times.hpp"

#include <fmt/format.h>

#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace tidemark::image {
namespace {

std::vector<std::string> input_arguments(const std::filesystem::path& path) {
    std::error_code ignored;
    if (std::filesystem::is_character_file(path, ignored))
        return {"-f", "v4l2", "-i", path.string()};
    std::vector<std::string> arguments = {"-re", "-stream_loop", "-1"};
    for (std::string& argument : video_input_arguments(path))
        arguments.push_back(std::move(argument));
    return arguments;
}

std::vector<std::string> camera_arguments(const std::filesystem::path& path) {
    std::vector<std::string> arguments = {"ffmpeg",   "-hide_banner", "-nostdin",
                                          "-nostats", "-loglevel",    "error"};
    for (std::string& argument : input_arguments(path))
        arguments.push_back(std::move(argument));
    const std::string filters =
        fmt::format("scale={0}:{1}:force_original_aspect_ratio=increase,crop={0}:{1},format=rgba,vflip",
                    k_camera_extent.width, k_camera_extent.height);
    for (const char* argument :
         {"-map", "0:V:0", "-vf", filters.c_str(), "-fps_mode", "passthrough", "-f", "rawvideo", "pipe:1"})
        arguments.emplace_back(argument);
    return arguments;
}

tl::unexpected<Error> cannot_see(const std::filesystem::path& path, std::string_view why) {
    return fail(ErrorCode::load, fmt::format("cannot see what '{}' shows: {}", path.string(), why));
}

} // namespace

class Camera::Feed {
public:
    explicit Feed(ChildProcess child) : child_(std::move(child)) {}
    Feed(const Feed&) = delete;
    Feed& operator=(const Feed&) = delete;
    ~Feed() {
        child_.stop();
        if (thread_.joinable())
            thread_.join();
    }

    void start() {
        thread_ = std::thread([this] {
            while (take_picture()) {
            }
        });
    }

    /// Waits for the next picture; returns false when there are no more.
    bool take_picture() {
        auto picture = std::make_shared<Image>(k_camera_extent, 4, SampleType::u8);
        for (size_t filled = 0; filled < picture->bytes.size();) {
            words_.clear(); // limits the stored messages
            const Result<size_t> count = child_.read(std::span(picture->bytes).subspan(filled), words_);
            if (!count || *count == 0)
                return false;
            filled += *count;
        }
        const std::lock_guard lock(mutex_);
        newest_ = std::move(picture);
        return true;
    }

    std::shared_ptr<const Image> newest() const {
        const std::lock_guard lock(mutex_);
        return newest_;
    }

    /// Returns the last line that ffmpeg printed on stderr.
    std::string_view complaint() const {
        const std::string_view text = std::string_view(words_).substr(0, words_.find_last_not_of('\n') + 1);
        return text.substr(text.rfind('\n') + 1);
    }

private:
    ChildProcess child_;
    std::string words_;
    mutable std::mutex mutex_;
    std::shared_ptr<const Image> newest_; ///< guarded by the mutex
    std::thread thread_;
};

Camera::Camera(std::unique_ptr<Feed> feed) : feed_(std::move(feed)) {}
Camera::Camera(Camera&&) noexcept = default;
Camera& Camera::operator=(Camera&&) noexcept = default;
Camera::~Camera() = default;

Result<Camera> Camera::open(const std::filesystem::path& path) {
    auto feed = std::make_unique<Feed>(
        TRY(ChildProcess::start(camera_arguments(path), ChildProcess::Input::none, k_get_ffmpeg)));
    if (!feed->take_picture())
        return cannot_see(path, feed->complaint().empty() ? "ffmpeg gives no picture" : feed->complaint());
    feed->start();
    return Camera(std::move(feed));
}

std::shared_ptr<const Image> Camera::newest() const {
    return feed_->newest();
}

} // namespace tidemark::image
