// Checks of a GPU and its driver: compares what they draw with IEEE 754, with the precision that Vulkan
// requires of GLSL's functions, and with other drawings. It draws only small texts of its own. A context must
// be current.
#pragma once

#include "base/error.hpp"
#include "lab/probes.hpp"
#include "render/compiled_scene.hpp"
#include "render/renderer.hpp"

#include <array>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::lab {

/// `warn`: scenes may look different from other devices. `fail`: Tidemark's numbers would be wrong.
struct DeviceAnswer {
    Verdict verdict = Verdict::pass;
    std::string sentence;
};

struct DeviceCheck {
    std::string_view name;
    Result<DeviceAnswer> (*ask)();
};

/// Returns all checks in the order in which they run: the cheap ones first.
std::span<const DeviceCheck> device_checks();

// The check functions, by subject.

// Numbers, and how long they take (device_numbers.cpp).
Result<DeviceAnswer> ask_special_values();
Result<DeviceAnswer> ask_arithmetic();
Result<DeviceAnswer> ask_contraction();
Result<DeviceAnswer> ask_doubles();
Result<DeviceAnswer> ask_functions();
Result<DeviceAnswer> ask_large_sines();
/// Measures the weights of operations and keeps them for the lens `cost` (lab/lens.hpp).
Result<DeviceAnswer> ask_weights();

// Drawing (device_drawing.cpp).
Result<DeviceAnswer> ask_read_back();
Result<DeviceAnswer> ask_read_ahead();
Result<DeviceAnswer> ask_bytes();
Result<DeviceAnswer> ask_repeatability();
Result<DeviceAnswer> ask_tiles();
Result<DeviceAnswer> ask_loops();

// Other driver features (device_drawing.cpp).
Result<DeviceAnswer> ask_program_cache();
Result<DeviceAnswer> ask_timer();
Result<DeviceAnswer> ask_reset();

// Whole projects (conformance.cpp).
Result<DeviceAnswer> ask_conformance();

// Computes numbers on the device by drawing a text, one sample per pixel.

/// Returns a renderer for a text with mainImage.
Result<render::Renderer> renderer_of(std::string_view text, const render::RenderOptions& options);

/// Red, green and blue of a pixel; an image's alpha is always 1.
using Sample = std::array<float, 3>;

/// Runs `statements` per sample and returns the results. They may use `uint i`, the sample's number, `uint
/// bits(uint)`, a hash, and `float spread(uint, a, b)`, a uniform number between a and b, and must assign
/// `c.rgb`. `count` is rounded up to whole rows of 256.
Result<std::vector<Sample>> samples_of(std::string_view statements, int count);

/// Runs a loop of that many iterations. Returns how many ran, and the low 16 bits of a sum over them.
Result<Sample> counted_loop(int iterations);

/// Returns the distance of two numbers in units in the last place of a float at `truth`.
double ulps_between(double truth, float got);

// Checks ShaderToy's semantics: draws small projects and compares pixels and sounds with values worked out by
// hand (tests/cases/conformance/README.md has the format).

/// Returns the folder's subfolders, one project each, sorted by name.
std::vector<std::filesystem::path> conformance_projects(const std::filesystem::path& folder);

/// Draws the project in its own size and sample type. Fails with the first pixel or sound sample that differs
/// from the rule, or if the project cannot be read or compiled.
Result<void> conforms(const std::filesystem::path& project, render::RenderOptions options = {});

} // namespace tidemark::lab
