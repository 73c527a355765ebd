// Goes through a frame that is drawn in parts: pass after pass, face after face, from the bottom row up;
// every pixel once, in parts as large as the caller wants them. Pure.
#pragma once

#include "base/rectangle.hpp"

#include <optional>
#include <vector>

namespace tidemark::render {

/// What is drawn of a pass.
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

/// A driver on the CPU draws blocks of so many pixels a side: a part begins and ends with one, or with the
/// picture. Derivatives are taken from blocks of 2x2, which lie in one part then.
inline constexpr int k_block_side = 4;

class PartCursor {
public:
    explicit PartCursor(std::vector<PassArea> areas) : areas_(std::move(areas)) {}

    /// The largest part that may be next; none: the frame is whole.
    std::optional<Part> ahead() const;
    /// The next one, of about so many pixels: never more unless a block has more. Goes on behind it.
    std::optional<Part> take(size_t pixels);
    /// The rest of the pass in front needs no drawing.
    void leave_out();

    /// Nothing of the pass in front was taken yet.
    bool begins_pass() const { return face_ == 0 && y_ == 0 && x_ == 0; }
    /// Of all pixels, those behind: 0 to 1.
    double share() const;

private:
    Rectangle cut(const Rectangle& rest, size_t pixels) const;
    void pass_by(const Rectangle& area);

    std::vector<PassArea> areas_;
    size_t index_ = 0; ///< of the area in front
    int face_ = 0;
    int y_ = 0;    ///< the bottom row of what is left of the face
    int x_ = 0;    ///< the first column that is left in the rows from there
    int rows_ = 0; ///< that many, where x_ is not 0
};

} // namespace tidemark::render
