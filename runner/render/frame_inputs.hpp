// The values of ShaderToy's uniforms, on which a frame depends. Equal inputs give equal pictures, whether
// they come from a window, a command line or a recording.
#pragma once

#include "base/result.hpp"
#include "render/keyboard.hpp"
#include "scene/setting.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <memory>
#include <string_view>
#include <vector>

namespace tidemark::render {

struct LiveMedia;

/// iDate: `month` counts from 0 as on ShaderToy; `seconds` since local midnight, with milliseconds.
struct Date {
    int year = 2024;
    int month = 0;
    int day = 1;
    double seconds = 43200;

    bool operator==(const Date&) const = default;
};

/// Reads `2024-12-31` or `2024-12-31T23:59:58.5` (months from 1).
Result<Date> parse_date(std::string_view iso);

/// Returns the local wall clock time.
Date local_date();

/// Adds seconds, which may be negative, to a date. Ignores time zones: a day has 86,400 seconds.
Date later(const Date& date, double seconds);

struct FrameInputs {
    int frame = 0;                ///< iFrame
    double time = 0;              ///< iTime, seconds
    double time_delta = 1 / 60.0; ///< iTimeDelta, seconds
    double frame_rate = 60;       ///< iFrameRate
    glm::vec4 mouse{0};           ///< iMouse, whole pixels, ShaderToy's signs
    Date date{};
    glm::mat4 camera{1}; ///< iCamera, camera to world
    glm::mat4 view{1};   ///< iViewMatrix: the same camera, relative to its first position
    /// iOrbit: rotation of the camera in azimuth and elevation, its distance, and 1 if the user moves it.
    glm::dvec4 orbit{0, 0, 1, 0};
    glm::dvec3 orbit_pan{0};   ///< iOrbitPan
    glm::vec2 mouse_button{0}; ///< iMouseButton: 1 while down; left, right
    KeyboardTexels keyboard{};
    std::vector<scene::Setting> knobs{};     ///< values that differ from the scene's
    std::shared_ptr<const LiveMedia> live{}; ///< null: not requested
};

inline constexpr double k_sample_rate = 44100; ///< iSampleRate

/// Limit of a recording's length: iFrame is an int, and a day at 60 frames a second is five million.
inline constexpr int k_last_frame = 100'000'000;

/// Returns the frame that contains a time, 0 to k_last_frame.
int frame_at(double time, double fps);

/// Returns the inputs of frame N of a recording at `fps` frames a second: iTime = N / fps, computed in
/// double, and iDate advanced by it.
FrameInputs inputs_of_frame(int frame, double fps);

} // namespace tidemark::render
