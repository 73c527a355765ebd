// The space of moments, knobs and mouse positions in which a search moves. Values only; nothing is drawn.
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
