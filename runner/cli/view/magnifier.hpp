// The magnifier of the window: reads the pixels around the pointer, and only while it is open.
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
    /// Follows the pointer; whether that changes what it shows.
    bool follow(const platform::InputEvent& event);

    /// The pixel of a picture that the pointer is on, when that picture fills the window.
    Rectangle pixel(Extent picture, Extent window) const;
    /// Of the frame on show, which `inputs` drew, in a window of that size. Nothing where the pointer is
    /// beside the window.
    std::optional<live::MagnifierField> field(const render::Renderer& renderer,
                                              const render::FrameInputs& inputs, Extent window,
                                              render::ShownFloats& floats) const;

private:
    bool open_ = false;
    platform::PointerPosition pointer_{};
};

} // namespace tidemark::cli
