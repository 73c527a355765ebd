// Makes the ICC profile that TIFF and JPEG files contain.
#pragma once

#include "image/transfer.hpp"

#include <cstddef>
#include <vector>

namespace tidemark::image {

/// Returns a version 4 profile with BT.709's primaries and the transfer curve, always the same bytes; empty
/// for Transfer::data.
std::vector<std::byte> icc_profile(Transfer transfer);

} // namespace tidemark::image
