#include "render/keyboard.hpp"

#include <algorithm>

namespace tidemark::render {
namespace {

constexpr int k_row = 256;

bool is_code(int code) {
    return code >= 0 && code < k_row;
}

} // namespace

void Keyboard::press(int code) {
    if (!is_code(code) || texels_[size_t(code)] != 0)
        return;
    texels_[size_t(code)] = 255;
    texels_[size_t(k_row + code)] = 255;
    uint8_t& toggle = texels_[size_t(2 * k_row + code)];
    toggle = uint8_t(255 - toggle);
}

void Keyboard::release(int code) {
    if (!is_code(code) || texels_[size_t(code)] == 0)
        return;
    texels_[size_t(3 * k_row + code)] = 255;
    texels_[size_t(code)] = 0;
    texels_[size_t(k_row + code)] = 0;
}

void Keyboard::frame_drawn() {
    for (const int row : {1, 3})
        std::fill_n(texels_.begin() + row * k_row, k_row, uint8_t{0});
}

} // namespace tidemark::render
