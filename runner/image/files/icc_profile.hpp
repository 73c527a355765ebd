// A profile of the International Color Consortium, as TIFF and JPEG hold it, that says what samples stand
// for.
#pragma once

#include "image/transfer.hpp"

#include <cstddef>
#include <vector>

namespace tidemark::image {

/// Version 4: BT.709's primaries and a curve. The same bytes each time. Of data: none.
std::vector<std::byte> icc_profile(Transfer transfer);

} // namespace tidemark::image
