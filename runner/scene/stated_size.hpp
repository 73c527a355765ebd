// The size that a scene states for its picture: `#iSize 800x450`.
#pragma once

#include "base/error.hpp"
#include "base/extent.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace tidemark::scene {

/// The size in an `#iSize` directive.
struct StatedSize {
    Extent extent;
    SourceLocation where{};
};

/// X11's limit for windows: it stores sizes in 16 bits with a sign.
inline constexpr int k_largest_stated_side = 32767;

/// Parses `800x450`; nullopt if it is something else or too large.
std::optional<Extent> size_of_text(std::string_view text);
std::string to_string(const Extent& size);

} // namespace tidemark::scene
