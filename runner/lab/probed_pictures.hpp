// Measures that picture probes share: visible differences, finite numbers, the time up to which float equals
// double.
//
// Measures of the difference between two pictures, by the value that 99 % of the pixels stay below. They
// define when probes call two pictures the same.
#pragma once

#include "lab/probe_bench.hpp"
#include "lab/probes.hpp"
#include "media/image.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tidemark::lab {

/// Two pictures look the same if 99 % of their pixels differ by no more than this: one step of 8 bits.
inline constexpr double k_visible_gap = 1.0 / 255;
/// The difference of 1 % of the pixels from which other rounding is a warning; a smaller one is a note.
inline constexpr double k_noticeable_gap = 0.05;

/// Returns the 99th percentile, over the pixels, of each pixel's largest sample difference. A sample that is
/// NaN or infinite in one picture only counts as 1. Pictures of floats, of one size.
double p99_difference(const image::Image& left, const image::Image& right);

/// Returns the percentage of the pixels that differ by more than k_visible_gap, counted in the same way.
double visibly_different_percent(const image::Image& left, const image::Image& right);

/// Returns whether a viewer would see two pictures of floats, of one size, as different: more than 5 % of
/// their blocks of 4x4 pixels differ in their mean by more than k_noticeable_gap, or one has much more
/// detail.
bool looks_different(const image::Image& left, const image::Image& right);

/// Returns whether a viewer would see what rounding does to the picture in float, beside that in double. With
/// `from_the_start` iTime is small, and other random details do not count: as bright, and with as much
/// detail.
bool breaks_up(const image::Image& floats, const image::Image& doubles, bool from_the_start);

/// Returns the PSNR, such as `35.1 dB`, of two float pictures of one size. If pixels hold a NaN or an
/// infinity in only one picture, or different ones in both, the text counts them and gives the PSNR of the
/// other pixels.
std::string alikeness(const image::Image& before, const image::Image& after);

/// Returns the number of pixels whose bytes differ; both pictures have the same size and format.
size_t different_pixels(const image::Image& left, const image::Image& right);

// Checks whether all numbers of a scene are finite in given situations. Counts by bits on the CPU.

/// Returns a duration in words: "40 minutes".
std::string duration_in_words(double seconds);

/// Returns how serious a fault is that shows in that state: `fail` with what a viewer meets in the promised
/// time, `warn` later, with other pictures in the channels or with the mouse outside, `note` before 0 s and
/// in pictures one pixel wide or high.
Verdict severity_in(const ProbeBench& bench, const FrameState& state);

/// Returns the fault of the first pass that has a NaN or an infinity, with the number of such pixels and a
/// picture that marks them; nothing if all passes are finite.
std::optional<Answer> not_finite(const ProbeBench& bench, const FrameState& state,
                                 const std::vector<PassPicture>& passes);

/// Checks every situation; the answer reports the first of the most serious that fail, and how many do.
Result<Answer> look(ProbeBench& bench, const std::vector<FrameState>& states);

/// Like `look`, but not applicable if the scene is not finite in the plain state already.
Result<Answer> look_anew(ProbeBench& bench, const std::vector<FrameState>& states);

// Finds the time up to which a scene looks the same in float and in double, at the iTime that floats have.

/// A moment at which more than 1 % of the pixels differ visibly between float and double.
struct Mismatch {
    double seconds = 0; ///< A power of ten. The picture is the one of state_at_float.
    FrameState state;
    image::Image floats, doubles;
    double difference = 0; ///< 99th percentile over the pixels
};

/// A moment at which the steps of iTime in binary32 are long enough to be seen.
struct TimeStep {
    double seconds = 0;    ///< a power of ten
    double step = 0;       ///< seconds
    double difference = 0; ///< between two pictures a step apart, in double: 99th percentile over the pixels
};

struct Horizon {
    double good = 0; ///< seconds: the last power of ten up to which both look the same; 0: they differ at 1 s
    std::optional<Mismatch> mismatch{};
    /// The first one before the mismatch or, without one, up to 10^6 s, that changes 1 % of the pixels
    /// visibly.
    std::optional<TimeStep> time_step{};
};

/// A line that loses digits of a pixel, and by what.
struct LostDigits {
    SourceLocation where;
    std::string sentence;
};

/// Returns where the pixel that differs most loses its digits, by a trace of it, such as `a.glsl:4 loses 6.1
/// digits`; nothing if that cannot be followed.
std::optional<LostDigits> where_digits_are_lost(ProbeBench& bench, const Mismatch& mismatch);

/// Compares at 1, 10, … 10^6 s (each plus a third). Fails if the scene cannot be drawn, or not in double.
Result<Horizon> find_horizon(ProbeBench& bench);

} // namespace tidemark::lab
