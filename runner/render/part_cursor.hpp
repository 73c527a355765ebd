// Iterates over a frame that is drawn in parts: pass by pass, face by face, from the bottom row up; every
// pixel once, in parts of the size that the caller requests. Pure.
#pragma once

#include "base/rectangle.hpp"

#include <optional>
#include <vector>

namespace tidemark::render {

/// The pixels of a pass.
struct PassArea {
    size_t pass = 0; ///< index into Scene::passes
    Extent extent;   ///< of a face
    int faces = 1;
};

/// Pixels that are drawn at once: whole rows, or some columns of a few rows.
struct Part {
    size_t pass = 0;
    int face = 0;
    Rectangle area;

    bool operator==(const Part&) const = default;
};

/// Block side of a driver on the CPU: parts begin and end at a block or at the picture's edge. The 2x2 blocks
/// for derivatives therefore lie within one part.
inline constexpr int k_block_side = 4;

class PartCursor {
public:
    explicit PartCursor(std::vector<PassArea> areas) : areas_(std::move(areas)) {}

    /// Returns the largest part that may be next; nothing when the frame is complete.
    std::optional<Part> ahead() const;
    /// Returns the next part, of about `pixels` pixels and more only if a block has more, and advances past
    /// it.
    std::optional<Part> take(size_t pixels);
    /// Skips the rest of the current pass.
    void leave_out();

    /// Returns whether the current pass has no parts taken yet.
    bool begins_pass() const { return face_ == 0 && y_ == 0 && x_ == 0; }
    /// Returns the fraction of all pixels that were taken, 0 to 1.
    double share() const;

private:
    Rectangle cut(const Rectangle& rest, size_t pixels) const;
    void pass_by(const Rectangle& area);

    std::vector<PassArea> areas_;
    size_t index_ = 0; ///< of the current area
    int face_ = 0;
    int y_ = 0;    ///< bottom row of the rest of the face
    int x_ = 0;    ///< first remaining column in the current rows
    int rows_ = 0; ///< number of current rows, if x_ is not 0
};

} // namespace tidemark::render
