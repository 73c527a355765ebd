// Inputs of probes: promises of the scene, states to draw, the space of a search.
//
// The limits that a scene promises to keep, read from a file beside it (`waves.check.json` for `waves.glsl`)
// and checked by `tidemark check`. Without the file the defaults below apply.
#pragma once

#include "base/error.hpp"
#include "lab/scene_numbers.hpp"
#include "render/frame_state.hpp"
#include "scene/scene.hpp"

#include <glm/vec2.hpp>

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tidemark::lab {

struct Promises {
    double time_horizon = 1e4;           ///< seconds up to which float and double must look the same
    double most_exhausted_percent = 0.1; ///< percent of the rays that may run out of steps
    double most_overstep_percent = 0;    ///< percent of the rays that may take a sample below the surface
    /// DB by which the PSNR of two neighbouring instants may drop below that of the instants around them.
    double smoothest_jump = 10;
    double space_horizon =
        1e3; ///< world units from its place up to which a camera must see the same in float and double
    /// Largest slope of march_field along a ray, per world unit; infinite: the scene states none.
    double largest_slope = std::numeric_limits<double>::infinity();
    std::set<std::string> stated; ///< the numbers above that the file sets
    /// Ranges for knobs and definitions that have none of their own; they also replace a knob's own range.
    std::map<std::string, std::pair<double, double>> ranges;
    std::map<std::string, std::string> skip; ///< probe: the reason for skipping it
};

/// Returns a name's definition in the scene's text, if there is one.
using DefinitionOf = std::function<std::optional<std::string>(const std::string& name)>;

/// Parses the text of such a file. Errors (ErrorCode::load) name `file` and the entry.
Result<Promises> parse_promises(std::string_view text, const std::string& file,
                                const DefinitionOf& definition_of);

// The states in which probes draw a scene.

using render::FrameState;

/// Small, as probes draw hundreds of pictures.
inline constexpr Extent k_probe_extent{64, 36};

/// Returns the unchanged scene at a time.
FrameState state_at(double seconds, Extent extent = k_probe_extent);
/// Returns the state a third of a second later than `seconds`, at the nearest time that binary32 has. Scenes
/// in float and in double get the same iTime then, so what differs is what the scene's own floats lose.
FrameState state_at_float(double seconds, FrameState state = {.extent = k_probe_extent});
/// Returns the state at 1 s.
FrameState plain_state(Extent extent = k_probe_extent);
/// Returns the moments of the probe `times`, from 0 to 16777216 s and one before 0, for any probe that
/// samples time.
std::vector<FrameState> usual_moments();
FrameState with_mouse(render::Mouse mouse, FrameState state = plain_state());

/// Returns the frame from which a scene with feedback is drawn: 8 before the state's if the state gives a
/// time, since drawing from the start could take days; 0 if it gives a frame only.
int first_frame_of(const FrameState& state);

/// Returns the scene with the state's channels, knobs and definitions applied. Fails if one of them is
/// invalid (ErrorCode::usage).
Result<scene::Scene> in_state(scene::Scene scene, const FrameState& state);

// The space of moments, knobs and mouse positions in which a search moves. Values only; nothing is drawn.

struct SearchPoint {
    double time = 1;                     ///< seconds
    std::vector<scene::KnobValue> knobs; ///< one value per knob of the scene
    std::optional<glm::dvec2> mouse{};   ///< fractions of the picture; none: never touched
    bool down = true;                    ///< state of the mouse button
};

/// One coordinate of a point.
struct SearchAxis {
    enum class Kind { time, knob, mouse } kind = Kind::time;
    size_t knob = 0;
    size_t component = 0;
    double low = 0; ///< of a knob
    double high = 1;
};

/// The inputs, besides knobs, that the scene reads.
struct SearchInputs {
    bool time = false;
    bool mouse = false;
};

class SearchSpace {
public:
    SearchSpace(const scene::Scene& scene, const Promises& promises, SearchInputs inputs);

    const std::vector<SearchAxis>& axes() const { return axes_; }
    SearchPoint plain() const;
    /// Returns points spread evenly over all inputs that the scene reads, including numbers from its text.
    /// Every prefix of the list is spread evenly, too.
    std::vector<SearchPoint> survey() const;

    FrameState state(const SearchPoint& point, Extent extent) const;

    static double value(const SearchPoint& point, const SearchAxis& axis);
    static void set(SearchPoint& point, const SearchAxis& axis, double value);

private:
    std::vector<double> moments() const;

    const scene::Scene& scene_;
    SearchInputs inputs_;
    std::vector<SearchAxis> axes_;
};

} // namespace tidemark::lab
