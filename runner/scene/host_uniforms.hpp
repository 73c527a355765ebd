// The table of the uniforms that the host sets: ShaderToy's, those of the VS Code extension, Tidemark's own,
// and other hosts' names for the same values. A row holds all properties of a uniform, except
// for its value in a frame: `render::value_of`.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace tidemark::scene {

/// The values that the host computes for uniforms; an index into `k_host_uniforms`.
enum class HostValue : unsigned char {
    resolution,
    time,
    time_delta,
    frame_rate,
    frame,
    mouse,
    date,
    sample_rate,
    channel_time,
    channel_resolution,
    time_offset,
    sample_offset,
    camera,
    orbit,
    orbit_pan,
    time_low,
    beat,
    mouse_button,
    view,
    relative_mouse,
};
inline constexpr size_t k_host_value_count = size_t(HostValue::relative_mouse) + 1;

enum class Declared : unsigned char {
    by_site,         ///< in every pass, as in ShaderToy's prologue
    by_host_if_read, ///< where a text reads it, as in the VS Code extension
    by_author        ///< by the scene's own text
};

/// What changes a value from frame to frame.
enum class Follows : unsigned char { nothing, clock, mouse, camera };

/// The range of a value's components while iTime is in an interval, for proofs.
struct RangeOverTime {
    enum class Kind : unsigned char {
        constant,     ///< as in the frame that was drawn
        between_ends, ///< between the values at both ends of the interval
        limits        ///< from `low` to `high`
    };
    Kind kind = Kind::constant;
    std::array<double, 4> low{};
    std::array<double, 4> high{};
};
inline constexpr RangeOverTime k_between_ends{.kind = RangeOverTime::Kind::between_ends};
constexpr RangeOverTime limits(double low, double high) {
    return {RangeOverTime::Kind::limits, {low}, {high}};
}
/// From 0 to any finite float, for values that options and slow frames set.
inline constexpr RangeOverTime k_any_from_0 = limits(0, 3.4028234663852886e38);

struct HostUniform {
    HostValue value{};
    std::string_view name{}; ///< empty: only other hosts have a name for the value
    std::string_view type{};
    int length = 0; ///< array length on ShaderToy; 0: not an array
    Declared declared = Declared::by_site;
    bool image = true;   ///< has a value in passes that draw pictures
    bool sound = false;  ///< declared in the Sound pass
    bool common = false; ///< declared on the site where it compiles Common by itself
    /// Names on glslsandbox.com, in glslViewer, in Bonzomatic and in the VS Code extension. A text outside of
    /// a project, or one with its own `main`, gets the value by these names too.
    std::array<std::string_view, 3> other_names{};
    Follows follows = Follows::nothing;
    RangeOverTime over_time{};
    /// A scene that needs the value looks wrong on ShaderToy's site, where it is zero.
    bool breaks_as_zero = false;
    std::string_view meaning{}; ///< hover text
    /// The value in an exported page: an array of `moment`, `size` and `channels` (web/host/uniforms.js).
    /// Empty: the page's Sound pass sets it.
    std::string_view script{};
};

/// Returns the number of components of a row's type, of one element if it is an array.
constexpr size_t component_count(const HostUniform& row) {
    return row.type == "mat4" ? 16 : row.type.starts_with("vec") ? size_t(row.type.back() - '0') : 1;
}

inline constexpr std::array k_host_uniforms{
    HostUniform{.value = HostValue::resolution,
                .name = "iResolution",
                .type = "vec3",
                .other_names = {"resolution", "u_resolution", "v2Resolution"},
                .meaning = "size of the picture in pixels; z is 1",
                .script = "[...size, 1]"},
    HostUniform{.value = HostValue::time,
                .name = "iTime",
                .type = "float",
                .other_names = {"time", "u_time", "fGlobalTime"},
                .follows = Follows::clock,
                .over_time = k_between_ends,
                .meaning = "seconds since the start",
                .script = "[moment.time]"},
    HostUniform{.value = HostValue::time_delta,
                .name = "iTimeDelta",
                .type = "float",
                .other_names = {"u_delta", "fFrameTime"},
                .follows = Follows::clock,
                .over_time = k_any_from_0,
                .meaning = "seconds since the previous frame",
                .script = "[moment.delta]"},
    HostUniform{.value = HostValue::frame_rate,
                .name = "iFrameRate",
                .type = "float",
                .follows = Follows::clock,
                .over_time = k_any_from_0,
                .meaning = "frames per second",
                .script = "[moment.rate]"},
    HostUniform{.value = HostValue::frame,
                .name = "iFrame",
                .type = "int",
                .other_names = {"u_frame"},
                .follows = Follows::clock,
                .over_time = limits(0, 2147483647),
                .meaning = "number of the frame, from 0",
                .script = "[moment.frame]"},
    HostUniform{.value = HostValue::mouse,
                .name = "iMouse",
                .type = "vec4",
                .other_names = {"u_mouse"},
                .follows = Follows::mouse,
                .meaning =
                    "mouse in pixels from the bottom left: xy the last position with the button down, zw the "
                    "position of the press; z is positive while the button is down, w in the first frame",
                .script = "moment.mouse.uniform"},
    HostUniform{.value = HostValue::date,
                .name = "iDate",
                .type = "vec4",
                .sound = true,
                .common = true,
                .other_names = {"u_date"},
                .follows = Follows::clock,
                .over_time = {RangeOverTime::Kind::limits, {0, 0, 1, 0}, {9999, 11, 31, 86400}},
                .meaning = "year, month from 0, day, seconds since midnight",
                .script = "moment.date"},
    HostUniform{.value = HostValue::sample_rate,
                .name = "iSampleRate",
                .type = "float",
                .sound = true,
                .common = true,
                .meaning = "samples of sound per second",
                .script = "[SAMPLE_RATE]"},
    HostUniform{.value = HostValue::channel_time,
                .name = "iChannelTime",
                .type = "float",
                .length = 4,
                .sound = true,
                .follows = Follows::clock,
                .over_time = k_between_ends,
                .meaning = "playback time of each channel's input in seconds",
                .script = "channelTimes(channels)"},
    HostUniform{.value = HostValue::channel_resolution,
                .name = "iChannelResolution",
                .type = "vec3",
                .length = 4,
                .sound = true,
                .meaning = "size of each channel's input in pixels",
                .script = "channelSizes(channels)"},
    HostUniform{.value = HostValue::time_offset,
                .name = "iTimeOffset",
                .type = "float",
                .image = false,
                .sound = true,
                .meaning = "time of the block's first sample in seconds"},
    HostUniform{.value = HostValue::sample_offset,
                .name = "iSampleOffset",
                .type = "int",
                .image = false,
                .sound = true,
                .meaning = "number of the block's first sample"},
    HostUniform{.value = HostValue::camera,
                .name = "iCamera",
                .type = "mat4",
                .declared = Declared::by_author,
                .follows = Follows::camera,
                .breaks_as_zero = true,
                .meaning = "the orbit camera, camera to world: right, up, backwards, position",
                .script = "moment.camera.matrix"},
    HostUniform{.value = HostValue::orbit,
                .name = "iOrbit",
                .type = "vec4",
                .declared = Declared::by_author,
                .follows = Follows::camera,
                .meaning =
                    "motion of the orbit camera: azimuth and elevation in radians, distance relative to the "
                    "first one, 1 if the user moves it",
                .script = "[...moment.camera.motion.orbit, 1]"},
    HostUniform{.value = HostValue::orbit_pan,
                .name = "iOrbitPan",
                .type = "vec3",
                .declared = Declared::by_author,
                .follows = Follows::camera,
                .meaning = "motion of the orbit camera's target, in first distances: right, up, backwards",
                .script = "moment.camera.motion.pan"},
    HostUniform{.value = HostValue::time_low,
                .name = "iTimeLow",
                .type = "float",
                .declared = Declared::by_author,
                .follows = Follows::clock,
                .over_time = limits(-1, 1),
                .meaning = "remainder of the time in seconds after iTime is rounded to a float",
                .script = "[moment.time - Math.fround(moment.time)]"},
    HostUniform{.value = HostValue::beat,
                .name = "iBeat",
                .type = "float",
                .declared = Declared::by_author,
                .follows = Follows::clock,
                .over_time = k_any_from_0,
                .breaks_as_zero = true,
                .meaning = "beats since the start, at the tempo of --bpm",
                .script = "[moment.time * moment.bpm / 60]"},
    HostUniform{.value = HostValue::mouse_button,
                .name = "iMouseButton",
                .type = "vec4",
                .declared = Declared::by_host_if_read,
                .follows = Follows::mouse,
                .meaning = "1 while a button is down: x left, y right",
                .script = "[Number(moment.mouse.down), Number(moment.mouse.right), 0, 0]"},
    HostUniform{.value = HostValue::view,
                .name = "iViewMatrix",
                .type = "mat4",
                .declared = Declared::by_host_if_read,
                .follows = Follows::camera,
                .meaning = "camera to world, the identity until the user moves the view",
                .script = "moment.camera.seenFrom(new OrbitCamera())"},
    HostUniform{.value = HostValue::relative_mouse,
                .type = "vec2",
                .declared = Declared::by_author,
                .other_names = {"mouse"},
                .follows = Follows::mouse,
                .meaning = "position of the mouse, 0 to 1 across the picture",
                .script = "[moment.mouse.uniform[0] / size[0], moment.mouse.uniform[1] / size[1]]"},
};

static_assert(k_host_uniforms.size() == k_host_value_count, "a value of HostValue has no row");
static_assert(
    [] {
        for (size_t i = 0; i < k_host_uniforms.size(); ++i)
            if (size_t(k_host_uniforms[i].value) != i || k_host_uniforms[i].meaning.empty())
                return false;
        return true;
    }(),
    "the rows are in the order of HostValue, each with its meaning");

constexpr const HostUniform& host_uniform(HostValue value) {
    return k_host_uniforms[size_t(value)];
}

/// Returns the row of a uniform's name; null: the host does not set it. `other_hosts`: accepts other hosts'
/// names too.
constexpr const HostUniform* find_host_uniform(std::string_view name, bool other_hosts = false) {
    for (const HostUniform& row : k_host_uniforms) {
        if (!name.empty() && name == row.name)
            return &row;
        for (const std::string_view other : row.other_names)
            if (other_hosts && !name.empty() && name == other)
                return &row;
    }
    return nullptr;
}

inline constexpr std::array<std::string_view, 10> k_channel_names{
    "iChannel0", "iChannel1", "iChannel2", "iChannel3", "iChannel4",
    "iChannel5", "iChannel6", "iChannel7", "iChannel8", "iChannel9"};
inline constexpr std::array<std::string_view, 4> k_channel_structs{"iCh0", "iCh1", "iCh2", "iCh3"};

/// Returns whether a scene must not use the name for a uniform of its own.
inline bool is_host_uniform(std::string_view name) {
    const auto is_name = [&](std::string_view taken) { return taken == name; };
    return find_host_uniform(name) != nullptr || std::ranges::any_of(k_channel_names, is_name) ||
           std::ranges::any_of(k_channel_structs, is_name) || name == "iChannel" || name == "iKeyboard" ||
           name.starts_with("tidemark_");
}

} // namespace tidemark::scene
