// The magnifier of the window. Reads the pixels around the pointer, only while it is open.
#pragma once

#include "live/magnifier_field.hpp"
#include "platform/input.hpp"
#include "render/renderer.hpp"
#include "render/shown_floats.hpp"

#include <optional>

namespace tidemark::cli {

class Magnifier {
public:
    void toggle() { open_ = !open_; }
    bool is_open() const { return open_; }
    /// Follows the pointer. Returns whether the magnifier must be shown again.
    bool follow(const platform::InputEvent& event);

    /// Returns the pixel under the pointer, for a picture that fills the window.
    Rectangle pixel(Extent picture, Extent window) const;
    /// Returns the magnifier of the frame on show, which was drawn with `inputs`. Returns nothing while it is
    /// closed or the pointer is outside the window.
    std::optional<live::MagnifierField> field(const render::Renderer& renderer,
                                              const render::FrameInputs& inputs, Extent window,
                                              render::ShownFloats& floats) const;

private:
    bool open_ = false;
    platform::PointerPosition pointer_{};
};

} // namespace tidemark::cli
