// Gives two pictures the same channels so that they can be compared: grey becomes red, green and blue, and a
// missing alpha is 1. Reports these changes; measures nothing.
#pragma once

#include "image/image.hpp"

#include <string>

namespace tidemark::image {

struct SameChannels {
    Image left;
    Image right;
    std::string note; ///< describes the changes, with A for left and B for right; empty: none
};

/// Gives both pictures the same channels. An alpha that only one picture has is dropped if it is 1
/// everywhere; otherwise the other picture gets an alpha of 1 and the two differ in it.
SameChannels same_channels(Image left, Image right);

} // namespace tidemark::image
