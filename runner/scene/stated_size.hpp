// The size that a scene says it is seen in: `#iSize 800x450`.
#pragma once

#include "base/error.hpp"
#include "base/extent.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace tidemark::scene {

/// What `#iSize` says.
struct StatedSize {
    Extent extent;
    SourceLocation where{};
};

/// No window is larger on X11, which counts its pixels in 16 bits, half of them below zero.
inline constexpr int k_largest_stated_side = 32767;

/// `800x450`; nothing where it is something else, or too large.
std::optional<Extent> size_of_text(std::string_view text);
std::string to_string(const Extent& size);

} // namespace tidemark::scene
