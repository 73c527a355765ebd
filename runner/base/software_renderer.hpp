// Recognises drivers that draw on the processor by their name.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace tidemark {

/// `renderer` is the value of GL_RENDERER.
inline bool is_software_renderer(std::string_view renderer) {
    constexpr std::array<std::string_view, 4> k_software{"llvmpipe", "softpipe", "SwiftShader", "Software"};
    return std::ranges::any_of(
        k_software, [&](std::string_view name) { return renderer.find(name) != std::string_view::npos; });
}

// Names the processor's maker: software drivers round as its instructions do (rcpps).

/// Returns `GenuineIntel` or `AuthenticAMD`, for example; empty if the processor has no such instruction.
std::string processor_maker();

} // namespace tidemark
