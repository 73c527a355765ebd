// The keyboard as ShaderToy's shaders see it.
#pragma once

#include <array>
#include <cstdint>

namespace tidemark::render {

/// The texels of the keyboard texture: rows of 256, a column for each JavaScript key code. Row 0: down; row
/// 1: pressed since the last frame; row 2: toggled by each press; row 3, which ShaderToy does not have but
/// the VS Code extension does: released since the last frame. 255 is yes.
using KeyboardTexels = std::array<uint8_t, 4 * 256>;

class Keyboard {
public:
    /// Codes outside 0..255 are ignored, and so is a press of a key that is down (auto-repeat).
    void press(int code);
    void release(int code);
    /// To be called when a frame has been drawn: its presses and releases are then no longer new.
    void frame_drawn();

    const KeyboardTexels& texels() const { return texels_; }

private:
    KeyboardTexels texels_{};
};

} // namespace tidemark::render
