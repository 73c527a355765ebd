// Two pictures of different channels made comparable: grey stands for red, green and blue, and an alpha that
// is not there is 1. Says what stands for what; measures nothing.
#pragma once

#include "image/image.hpp"

#include <string>

namespace tidemark::image {

struct SameChannels {
    Image left;
    Image right;
    std::string note; ///< in words, the left being A and the right B; empty: they had the same channels
};

/// An alpha that only one picture has is left out where it is 1 throughout, for then it says nothing; else
/// the other picture is given one of 1, and the two differ in it.
SameChannels same_channels(Image left, Image right);

} // namespace tidemark::image
