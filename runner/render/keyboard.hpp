// The keyboard in the form of ShaderToy's keyboard texture.
#pragma once

#include <array>
#include <cstdint>

namespace tidemark::render {

/// Texels of the keyboard texture: rows of 256, with a column per JavaScript key code. Row 0: down; row 1:
/// pressed since the last frame; row 2: toggled by each press; row 3, which the VS Code extension has and
/// ShaderToy has not: released since the last frame. 255 is yes.
using KeyboardTexels = std::array<uint8_t, 4 * 256>;

class Keyboard {
public:
    /// Ignores codes outside 0..255, and the press of a key that is down (auto-repeat).
    void press(int code);
    void release(int code);
    /// Clears the rows of new presses and releases; must be called after each frame.
    void frame_drawn();

    const KeyboardTexels& texels() const { return texels_; }

private:
    KeyboardTexels texels_{};
};

} // namespace tidemark::render
