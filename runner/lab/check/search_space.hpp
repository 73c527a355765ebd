// The moments, knobs and places of the mouse in which a scene can be: what a search moves in. Values only.
#pragma once

#include "lab/check/probe_state.hpp"
#include "lab/check/promises.hpp"
#include "scene/scene.hpp"

#include <glm/vec2.hpp>

#include <optional>
#include <vector>

namespace tidemark::lab {

struct SearchPoint {
    double time = 1;                     ///< seconds
    std::vector<scene::KnobValue> knobs; ///< one for each of the scene's
    std::optional<glm::dvec2> mouse{};   ///< shares of the picture; none: never touched
    bool down = true;                    ///< the mouse's button
};

/// One number of a point.
struct SearchAxis {
    enum class Kind { time, knob, mouse } kind = Kind::time;
    size_t knob = 0;
    size_t component = 0;
    double low = 0; ///< of a knob
    double high = 1;
};

/// What of it the scene reads.
struct SearchInputs {
    bool time = false;
    bool mouse = false;
};

class SearchSpace {
public:
    SearchSpace(const scene::Scene& scene, const Promises& promises, SearchInputs inputs);

    const std::vector<SearchAxis>& axes() const { return axes_; }
    SearchPoint plain() const;
    /// Points spread evenly over all that the scene reads, the numbers of its text among them, in an order in
    /// which any beginning of the list is spread so, too.
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
