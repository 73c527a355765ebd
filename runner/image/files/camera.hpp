// What a camera shows at the moment, through the program `ffmpeg` as a child process, as videos are read.
#pragma once

#include "base/extent.hpp"
#include "base/result.hpp"
#include "image/image.hpp"

#include <filesystem>
#include <memory>

namespace tidemark::image {

/// Of every picture of a camera, which is scaled, and cut at its longer side, to that.
inline constexpr Extent k_camera_extent{640, 480};

/// A thread of its own takes the pictures as they come; to be used from another. No child outlives this
/// object.
class Camera {
public:
    /// A device of Video4Linux such as `/dev/video0`, or a video, played at its own pace, again and again.
    /// Waits for the first picture. ErrorCode::load says why there is none.
    static Result<Camera> open(const std::filesystem::path& path);
    Camera(Camera&&) noexcept;
    Camera& operator=(Camera&&) noexcept;
    ~Camera();

    /// RGBA, u8, row 0 the bottom row. The last one stays when there are no more.
    std::shared_ptr<const Image> newest() const;

private:
    class Feed;
    explicit Camera(std::unique_ptr<Feed> feed);

    std::unique_ptr<Feed> feed_;
};

} // namespace tidemark::image
