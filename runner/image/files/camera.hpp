// Delivers the current picture of a camera, through a child process `ffmpeg`.
#pragma once

#include "base/extent.hpp"
#include "base/result.hpp"
#include "image/image.hpp"

#include <filesystem>
#include <memory>

namespace tidemark::image {

/// The size of camera pictures: they are scaled to it, and cropped on the longer side.
inline constexpr Extent k_camera_extent{640, 480};

/// A thread receives the pictures; the object is for use on another thread. The child process ends with the
/// object.
class Camera {
public:
    /// Opens a Video4Linux device such as `/dev/video0`, or a video, which is looped at its own speed. Waits
    /// for the first picture. Fails with the reason (ErrorCode::load) when there is none.
    static Result<Camera> open(const std::filesystem::path& path);
    Camera(Camera&&) noexcept;
    Camera& operator=(Camera&&) noexcept;
    ~Camera();

    /// Returns the newest picture: RGBA, u8, row 0 the bottom row. It stays when no more pictures come.
    std::shared_ptr<const Image> newest() const;

private:
    class Feed;
    explicit Camera(std::unique_ptr<Feed> feed);

    std::unique_ptr<Feed> feed_;
};

} // namespace tidemark::image
