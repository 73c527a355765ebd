// All inputs of a frame as values: keyboard, mouse, camera, uniforms, and the state from which they follow.
//
// The keyboard in the form of ShaderToy's keyboard texture.
#pragma once

#include "base/error.hpp"
#include "base/extent.hpp"
#include "scene/channel.hpp"
#include "scene/host_uniforms.hpp"
#include "scene/knob.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace tidemark::render {

/// Texels of the keyboard texture: rows of 256, with a column per JavaScript key code. Row 0: down; row 1:
/// pressed since the last frame; row 2: toggled by each press; row 3, which the VS Code extension has and
/// ShaderToy has not: released since the last frame. 255 is yes.
using KeyboardTexels = std::array<uint8_t, 4 * 256>;

class Keyboard {
public:
    /// Ignores codes outside 0..255, and the press of a key that is down (auto-repeat).
    void press(int code);
    void release(int code);
    /// Clears the rows of new presses and releases; must be called after each frame.
    void frame_drawn();

    const KeyboardTexels& texels() const { return texels_; }

private:
    KeyboardTexels texels_{};
};

// The mouse in the form of ShaderToy's iMouse.

/// iMouse through press, drag and release. Coordinates are pixels from the bottom left, rounded down. xy
/// moves only while the button is down; zw holds the place of the press: z is positive while the button is
/// down, w only in the first frame drawn after the press.
struct Mouse {
    void press(double x, double y);
    void move(double x, double y);
    void release() { down = false; }

    /// Returns iMouse of the next frame.
    glm::vec4 uniform() const;
    /// Returns the mouse after a click; `now`: in the frame of the press itself.
    static Mouse clicked(glm::dvec2 at, bool now);
    /// Returns the mouse after a drag; `held`: the button is still down.
    static Mouse dragged(glm::dvec2 from, glm::dvec2 to, bool held);
    /// Scales the coordinates to a picture of another size.
    void stretch(Extent from, Extent to);
    /// Ends the first frame of a click; must be called after each frame.
    void frame_drawn() { is_new = false; }

    bool operator==(const Mouse&) const = default;

    glm::vec2 position{0};
    glm::vec2 pressed_at{0};
    bool down = false;
    bool is_new = false; ///< no frame has been drawn since the press
};

// The host's own camera, for scenes that declare iCamera or iOrbit.

/// Circles a target at a distance. World y is up; at azimuth and elevation 0 the camera stands on the
/// positive z axis and looks along negative z. Angles in degrees.
struct OrbitCamera {
    double azimuth = 30;   ///< eastward, wrapped to [0, 360)
    double elevation = 20; ///< clamped to +-89.9: at the pole "up" has no direction
    double distance = 10;  ///< positive
    glm::dvec3 target{0};

    bool operator==(const OrbitCamera&) const = default;

    /// Rotates by a drag of so many pixels in a window `height` pixels high; `height` pixels are half a
    /// circle.
    void turn(double dx, double dy, double height);
    /// Zooms by wheel notches; positive: towards the target.
    void zoom(double notches);
    /// Moves the target by a drag, so that the point under the pointer at the target's distance stays there.
    void pan(double dx, double dy, double height);

    /// Returns camera to world: columns right, up, backwards, position.
    glm::mat4 matrix() const;
};

/// Motion of a camera relative to the host's first view, at which all is exactly 0 and the distance 1. The
/// pan is in first distances along the axes of the first heading: right, up, backwards.
struct OrbitMotion {
    glm::dvec2 turn; ///< azimuth and elevation, radians
    double distance; ///< relative to the first distance
    glm::dvec3 pan;  ///< of the target
};
OrbitMotion motion_of(const OrbitCamera& camera);

/// Reads `azimuth,elevation,distance`, optionally followed by the target `,x,y,z` (default: the origin).
Result<OrbitCamera> parse_camera(std::string_view setting);

// The values of ShaderToy's uniforms, on which a frame depends. Equal inputs give equal pictures, whether
// they come from a window, a command line or a recording.

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
    double bpm = 120;             ///< beats per minute, of iBeat
    glm::vec4 mouse{0};           ///< iMouse, whole pixels, ShaderToy's signs
    Date date{};
    glm::mat4 camera{1}; ///< iCamera, camera to world
    glm::mat4 view{1};   ///< iViewMatrix: the same camera, relative to its first position
    /// iOrbit: rotation of the camera in azimuth and elevation, its distance, and 1 if the user moves it.
    glm::dvec4 orbit{0, 0, 1, 0};
    glm::dvec3 orbit_pan{0};   ///< iOrbitPan
    glm::vec2 mouse_button{0}; ///< iMouseButton: 1 while down; left, right
    KeyboardTexels keyboard{};
    std::vector<scene::KnobSetting> knobs{}; ///< values that differ from the scene's
    std::shared_ptr<const LiveMedia> live{}; ///< null: not requested
};

/// Values of the channel uniforms for one channel.
struct ChannelFact {
    std::array<double, 3> resolution{}; ///< iChannelResolution
    double time = 0;                    ///< iChannelTime
    bool loaded = false;                ///< iChN.loaded
};
using ChannelFacts = std::array<ChannelFact, scene::k_channel_count>;

class UniformNumbers;
/// Returns the value of a host uniform in a pass: `resolution` is its size in pixels.
UniformNumbers value_of(scene::HostValue value, const FrameInputs& inputs, Extent resolution,
                        const ChannelFacts& channels);

inline constexpr double k_sample_rate = 44100; ///< iSampleRate

/// Limit of a recording's length: iFrame is an int, and a day at 60 frames a second is five million.
inline constexpr int k_last_frame = 100'000'000;

/// Returns the frame that contains a time, 0 to k_last_frame.
int frame_at(double time, double fps);

/// Returns the inputs of frame N of a recording at `fps` frames a second: iTime = N / fps, computed in
/// double, and iDate advanced by it.
FrameInputs inputs_of_frame(int frame, double fps);

// One moment of a scene: all that determines a frame apart from the scene's files. Windows, recordings and
// probes describe a frame by this value, and `inputs_of` computes ShaderToy's uniforms from it. A new field
// needs a row in `k_frame_fields`.

struct FrameState {
    int frame = 0;                ///< iFrame
    std::optional<double> time{}; ///< iTime, seconds; none: frame / fps
    Extent extent{640, 360};
    double fps = 60;                             ///< iFrameRate
    double bpm = 120;                            ///< beats per minute, of iBeat
    std::optional<double> time_delta{};          ///< iTimeDelta, seconds; none: 1 / fps
    Mouse mouse{};                               ///< iMouse, and the left button of iMouseButton
    bool right_button = false;                   ///< down; of iMouseButton
    KeyboardTexels keys{};                       ///< texels of the keyboard texture
    Date date{};                                 ///< iDate at iTime 0
    OrbitCamera camera{};                        ///< iCamera
    std::optional<OrbitCamera> initial_camera{}; ///< first position, for iViewMatrix; none: `camera`
    std::vector<scene::KnobSetting> knobs{};     ///< values that differ from the scene's
    /// Values of `#define NAME` and `const … NAME` that differ from the scene's.
    std::vector<scene::Setting> definitions{};
    std::vector<std::string> channels{}; ///< in the form of --channel: `0=none`
    std::string pass{};                  ///< pass to show; empty: Image

    bool operator==(const FrameState&) const = default;

    /// Returns iTime.
    double seconds() const { return time.value_or(double(frame) / fps); }
    /// Returns whether the mouse moves the camera, as in a window. If so, the mouse position was not set by
    /// an option of its own.
    bool moves_camera() const { return camera != OrbitCamera{} || (initial_camera && mouse != Mouse{}); }
    /// Returns another frame of the same run; its time differs by the number of frames between them.
    FrameState at_frame(int number) const;
    /// Returns whether `other` is a frame of the same run, apart from rounding of its time.
    bool is_in_run_of(const FrameState& other) const;
};

// The fields of FrameState, from which its JSON and its command line are made. A missing field does not
// compile.

/// A field of type double is a number above 0 that holds for a whole run. Its option is made from its row,
/// and an exported page gets it.
template <class T>
struct FrameField {
    std::string_view name;
    T FrameState::*member;
    std::string_view option{};                 ///< of `tidemark capture`; empty: none
    std::string_view placeholder{}, meaning{}; ///< help of a number's option
};
template <class T>
FrameField(std::string_view, T FrameState::*, std::string_view = {}, std::string_view = {},
           std::string_view = {}) -> FrameField<T>; // for clang 14

inline constexpr auto k_frame_fields = std::tuple{
    FrameField{"frame", &FrameState::frame, "--frame"},
    FrameField{"time", &FrameState::time, "--time"},
    FrameField{"size", &FrameState::extent, "--size"},
    FrameField{"fps", &FrameState::fps, "--fps", "F", "Time step: iTime = frame / F, iTimeDelta = 1 / F"},
    FrameField{"bpm", &FrameState::bpm, "--bpm", "B", "Beats per minute: iBeat = iTime * B / 60"},
    FrameField{"time_delta", &FrameState::time_delta},
    FrameField{"mouse", &FrameState::mouse, "--mouse"},
    FrameField{"right_button", &FrameState::right_button},
    FrameField{"keys", &FrameState::keys},
    FrameField{"date", &FrameState::date, "--date"},
    FrameField{"camera", &FrameState::camera, "--camera"},
    FrameField{"initial_camera", &FrameState::initial_camera},
    FrameField{"knobs", &FrameState::knobs, "--set"},
    FrameField{"definitions", &FrameState::definitions, "--define"},
    FrameField{"channels", &FrameState::channels, "--channel"},
    FrameField{"pass", &FrameState::pass, "--pass"},
};

/// Ties all members of a state; compiles only if the number of names is the number of fields.
constexpr auto tied(const FrameState& state) {
    const auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16] = state;
    return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15, f16);
}
static_assert(std::tuple_size_v<decltype(k_frame_fields)> ==
              std::tuple_size_v<decltype(tied(std::declval<FrameState>()))>);

/// Calls `see(field)` for each row.
template <class See>
void for_each_field(See&& see) {
    std::apply([&](const auto&... field) { (see(field), ...); }, k_frame_fields);
}

/// Calls `see(field)` for each number, a field of type double.
template <class See>
void for_each_number(See&& see) {
    for_each_field([&]<class T>(const FrameField<T>& field) {
        if constexpr (std::is_same_v<T, double>)
            see(field);
    });
}

/// Returns the state at a time, in the frame that contains it; times before 0 are in frame 0.
FrameState at_time(double seconds, FrameState state = {});

/// Computes the uniforms' values.
FrameInputs inputs_of(const FrameState& state);

/// Returns the state of each frame of a run.
using FrameStates = std::function<FrameState(int frame)>;

} // namespace tidemark::render
