// A scene's knobs as the shader sees them: numbers rounded to binary32, by name.
#pragma once

#include "base/error.hpp"
#include "scene/knob.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <optional>
#include <span>
#include <string_view>

namespace tidemark::fields {

/// Reads knobs one by one and remembers the first that is not there or not to be had; ask `error()` once at
/// the end.
class KnobReader {
public:
    explicit KnobReader(std::span<const scene::Knob> knobs) : knobs_(knobs) {}

    double number(std::string_view name) { return float(value(name)[0]); }
    /// A number that the field's bounds take for no less than 0: another one is an error.
    double not_negative(std::string_view name);
    glm::dvec2 pair(std::string_view name);
    glm::dvec3 triple(std::string_view name);
    glm::dvec4 quadruple(std::string_view name);

    const std::optional<Error>& error() const { return error_; }

private:
    scene::KnobValue value(std::string_view name);

    std::span<const scene::Knob> knobs_;
    std::optional<Error> error_;
};

} // namespace tidemark::fields
