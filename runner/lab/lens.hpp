// A lens replaces the picture of a scene by one number per pixel: its cost, the iterations of its march, the
// value of a variable. `make_lens` plans it, `read_lens` reads the numbers of a drawn frame, `draw_lens`
// makes a picture of them with a colour bar and a legend. For the command line and the window alike.
#pragma once

#include "base/error.hpp"
#include "base/measurement.hpp"
#include "media/image.hpp"
#include "render/frame_state.hpp"
#include "render/renderer.hpp"
#include "scene/scene.hpp"
#include "shader/lens_text.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::lab {

enum class LensName {
    cost,     ///< weighted operations executed
    steps,    ///< iterations of a march or of another loop
    error,    ///< float against double
    rounding, ///< largest change under the arithmetic of other GPUs
    proof,    ///< march pixels: proved right, or wrong in a known way
    clocks,   ///< cycles of the device's clock
    value,    ///< a variable of a line
    branch,   ///< which way a condition went
};
inline constexpr size_t k_lenses = 8;
enum class LineUse { none, optional, required };
/// How a lens is named, and what follows its name.
struct LensForm {
    std::string_view name;
    std::string_view form;        ///< as in `--lens`
    std::string_view description; ///< one sentence for lists and hover texts
    LineUse line;
    std::string_view second{}; ///< label of what may follow the line: "name", "number"; empty: nothing
};
const LensForm& form_of(LensName name);
std::string_view to_string(LensName name);

struct Lens {
    LensName name = LensName::steps;
    /// The line of `steps`, `value` and `branch`; only `steps` may lack it. Without a file: that of
    /// mainImage.
    std::optional<SourceLocation> place{};
    std::string variable{}; ///< of `value`: a name, perhaps with members; empty: the only one that is set
    glsl::SeenValue::Pick pick = glsl::SeenValue::Pick::last; ///< of `value`
    uint32_t number = 1; ///< of `value`: with Pick::number; of `branch`: which condition, 0: the only one
    std::string pass{};  ///< "Buffer A"; empty: Image
};

/// Parses `steps`, `steps:LINE`, `value:LINE[:NAME][@N|@min|@max]`, `branch:LINE[:N]`; LINE may be FILE:LINE.
/// The error (ErrorCode::usage) says what to write, without the text.
Result<Lens> parse_lens(std::string_view text);
/// Returns the text that parse_lens reads.
std::string to_string(const Lens& lens);

/// How the numbers are found.
enum class Basis {
    counted,  ///< by the instrumented text, on the device
    measured, ///< from pictures of the device
    modelled, ///< from pictures with the arithmetic of other devices
    proved,   ///< from the text, for real arithmetic
};
std::string_view to_string(Basis basis);

/// A value of a lens whose numbers are indices.
struct LensClass {
    std::string_view name;
    std::array<uint8_t, 3> colour; ///< sRGB
};

struct LensPlan {
    Lens lens;
    std::string title;   ///< for example "iterations of the march at canyon.glsl:40"
    std::string unit;    ///< of the numbers; empty for classes
    std::string excerpt; ///< source of the value or of the condition; empty for other lenses
    Basis basis = Basis::counted;
    bool logarithmic = false;
    std::string marked;                   ///< meaning of marked pixels, "run out"; empty: there are none
    std::string absent;                   ///< meaning of pixels without a number, "not reached"
    std::span<const LensClass> classes{}; ///< not empty: the numbers are indices of these
    int components = 1;                   ///< 3: colours; 0: known from the numbers
    /// A scene to draw beside the plain one, in the same moment, size and floats; nothing: none is needed.
    /// Its Image holds the numbers, or the picture in double.
    std::optional<scene::Scene> drawn{};
    glsl::Precision precision = glsl::Precision::single; ///< of `drawn`
    size_t pass = 0;          ///< index in the scene of the pass whose numbers these are
    bool of_buffer = false;   ///< that pass is a buffer, whose values are not those of a screen
    std::string drawn_pass{}; ///< the pass of `drawn` to draw; empty: Image
    std::string more_basis{}; ///< says more about the basis: "weights of the table"; empty: nothing
};

/// Returns why there are no numbers: the first diagnostic of the error, or its message.
std::string reason_of(const Error& error);

/// Plans a lens. Needs no context. `weights` are those of `cost`. The error says why the scene has no such
/// numbers, or (ErrorCode::usage) what is wrong with the line.
Result<LensPlan> make_lens(const scene::Scene& scene, const Lens& lens,
                           const glsl::WorkWeights& weights = {});

/// Returns the weights that `measure_weights` has measured on the device of the current context, from the
/// cache; those of the table if there are none.
glsl::WorkWeights device_weights();
/// A measured weight with its 95 % interval.
struct MeasuredWeight {
    glsl::Operation operation;
    double weight;
    Interval interval;
};
struct MeasuredWeights {
    glsl::WorkWeights weights;
    std::vector<MeasuredWeight> each;
    double sum_picoseconds = 0; ///< time of a sum of two floats, over all cores
    bool steady = false;        ///< the times of the rounds agree
    bool kept = false;          ///< in the cache
};
/// Measures the weights of the current context's device in some seconds and keeps them in the cache: of CPU
/// time if the CPU draws, else of time on the clock.
Result<MeasuredWeights> measure_weights();
/// For example "weights measured on llvmpipe".
std::string basis_of(const glsl::WorkWeights& weights);
/// Returns the options for the renderer of `LensPlan::drawn`.
render::RenderOptions lens_options(const LensPlan& plan, Extent extent);

/// One to three numbers for each pixel, rows from the bottom.
struct LensNumbers {
    enum class Mark : uint8_t { absent, number, marked };
    Extent extent{};
    int components = 1;
    std::vector<float> values{}; ///< `components` for each pixel; 0 where absent
    std::vector<Mark> marks{};
    std::string note{};   ///< for the legend, such as the worst variant; empty: none
    bool complete = true; ///< false: `keep_going` stopped it; pixels without a number are not known yet

    float at(size_t pixel, int component = 0) const {
        return values[pixel * size_t(components) + size_t(component)];
    }
};

/// A frame that was drawn.
struct LensFrame {
    render::Renderer& plain; ///< the scene itself
    render::Renderer* drawn; ///< of LensPlan::drawn; null if there is none
    render::FrameInputs inputs;
};

/// The grid, in pixels, that `proof` takes first; each finer one has half of its spacing.
inline constexpr int k_coarsest_stride = 16;

/// Reads the numbers. Fails (ErrorCode::load) if the instrumented text drew another picture than the plain
/// one, compared in bytes. `rounding` and `proof` work here, until `keep_going` returns false.
Result<LensNumbers> read_lens(const LensPlan& plan, const LensFrame& frame, const KeepGoing& keep_going);

/// A line of the text and its part of the work.
struct HotLine {
    SourceLocation where;
    std::string text;                   ///< without surrounding blanks
    double share = 0;                   ///< 0 to 1; of the time if it was measured, else of the counted work
    double counted = 0;                 ///< share of the counted work
    std::optional<Interval> interval{}; ///< 95 %, of a measured share; nothing: it was counted
};
struct HotLines {
    double operations = 0;                  ///< weighted, per pixel: the mean
    std::vector<HotLine> lines{};           ///< the most expensive first
    std::string basis{};                    ///< basis_of the weights
    std::vector<std::string> not_counted{}; ///< passes that are left out, each with the reason
    bool measured = false;                  ///< at least one line was
};
/// Counts the lines of all passes that the frame draws, in that moment and size; returns the first `most`.
/// With the weights of a device that runs pixels together or both sides of branches, it counts what the
/// device runs. `state.pass`: counts only that pass. `seconds` above 0: measures the most expensive lines for
/// about that long, each by doing its operations twice. A context must be current.
Result<HotLines> hot_lines(const scene::Scene& scene, const render::FrameState& state, size_t most,
                           const glsl::WorkWeights& weights = {}, double seconds = 0);

/// A share of the time with its 95 % interval.
struct LineShare {
    double share = 0;
    Interval interval{};
};
/// Returns what a line takes, from the additional times of the rounds in which it was done twice, each as a
/// part of the plain time. `factor`: the line's counted work for each part of it that was repeated.
LineShare measured_share(const std::vector<double>& more, double factor);

/// Statistics of the finite numbers: of all components together.
struct LensSummary {
    size_t pixels = 0, numbers = 0; ///< all pixels; those with a number, marked ones included
    size_t marked = 0, nan = 0, infinite = 0;
    double least = 0, median = 0, p99 = 0, most = 0; ///< NaN if there are no finite numbers
    std::vector<size_t> classes{};                   ///< number of pixels of each class
    size_t parting = 0; ///< pixels whose class differs from that of the pixel to the right or above
};
LensSummary summary_of(const LensPlan& plan, const LensNumbers& numbers);

/// The range of the colour bar, from round numbers; of a logarithmic lens powers of ten.
struct LensRange {
    double low = 0, high = 1;
};
LensRange range_of(const LensPlan& plan, const LensSummary& summary);

/// Returns the place of a number on the bar, 0 to 1.
double place_on_bar(const LensPlan& plan, const LensRange& range, double value);

/// Returns a number as the legend writes it.
std::string legend_number(double value);

/// An entry of the legend: a coloured box, or none, and words.
struct LegendEntry {
    std::optional<std::array<uint8_t, 3>> box;
    std::string words;
};
/// Returns a share from 0 to 1 in per cent, with three digits or as many as it takes: only 0 is "0 %" and
/// only 1 is "100 %".
std::string share_words(double share);
/// Returns the entries below the bar.
std::vector<LegendEntry> legend_of(const LensPlan& plan, const LensSummary& summary,
                                   const LensNumbers& numbers);
/// Returns the second line of the legend: the lens, its unit and its basis.
std::string basis_line(const LensPlan& plan);

/// Returns the colour of a number from 0 (dark blue) to 1 (yellow), sRGB: rising brightness, the same order
/// for colour-blind eyes.
std::array<uint8_t, 3> lens_colour(double part);

/// Draws the numbers without a legend: RGBA bytes. Absent pixels are black, marked ones white, NaN magenta,
/// infinities cyan.
image::Image lens_map(const LensPlan& plan, const LensNumbers& numbers);
/// Returns the size of a lens's picture that holds the legend of any frame: for sequences, whose pictures
/// have one size. At least 240 pixels wide; both sides are even. A narrow legend has more rows.
Extent legend_extent(const LensPlan& plan, Extent map);
/// Returns a size that holds the legend of any lens.
Extent largest_legend_extent(Extent map);
/// Draws the map with a legend below it: RGBA bytes. Without `extent` the legend has as many rows as its text
/// needs.
image::Image draw_lens(const LensPlan& plan, const LensNumbers& numbers,
                       std::optional<Extent> extent = std::nullopt);
/// Returns the lines of the legend as text: title, range, statistics.
std::vector<std::string> legend_lines(const LensPlan& plan, const LensNumbers& numbers);

/// Returns the three bytes of a colour as shown, as instrumented texts compute them too: NaN is 0.
uint32_t bytes_of_colour(const float* colour);

/// Returns the numbers as a picture of RGBA floats: up to three numbers; alpha is 0 where absent, 2 where
/// marked, else 1.
image::Image raw_numbers(const LensNumbers& numbers);

} // namespace tidemark::lab
