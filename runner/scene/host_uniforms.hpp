// The uniforms that the host sets: those of ShaderToy's prologue, the VS Code extension's and Tidemark's own.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace tidemark::scene {

/// A uniform that ShaderToy's prologue declares.
struct SiteUniform {
    std::string_view name;
    std::string_view type;
    int length = 0;     ///< array length; 0: not an array
    bool image = true;  ///< declared in passes that draw pictures
    bool sound = false; ///< declared in the Sound pass
};

inline constexpr SiteUniform k_site_uniforms[] = {
    {"iResolution", "vec3"},
    {"iTime", "float"},
    {"iTimeDelta", "float"},
    {"iFrameRate", "float"},
    {"iFrame", "int"},
    {"iMouse", "vec4"},
    {"iDate", "vec4", 0, true, true},
    {"iSampleRate", "float", 0, true, true},
    {"iChannelTime", "float", 4, true, true},
    {"iChannelResolution", "vec3", 4, true, true},
    {"iTimeOffset", "float", 0, false, true},
    {"iSampleOffset", "int", 0, false, true},
};

inline constexpr std::array<std::string_view, 10> k_channel_names{
    "iChannel0", "iChannel1", "iChannel2", "iChannel3", "iChannel4",
    "iChannel5", "iChannel6", "iChannel7", "iChannel8", "iChannel9"};
inline constexpr std::array<std::string_view, 4> k_channel_structs{"iCh0", "iCh1", "iCh2", "iCh3"};

/// The VS Code extension's own: the mouse buttons that are down (x left, y right), and a camera-to-world
/// matrix that is the identity until the user moves the view.
inline constexpr std::string_view k_mouse_button_uniform = "iMouseButton";
inline constexpr std::string_view k_view_uniform = "iViewMatrix";

/// Tidemark's own, for scenes that declare them: the matrix of the orbit camera; for scenes with a camera of
/// their own, how the user moved it (orbit and pan); and the remainder of the time in seconds after iTime is
/// rounded to a float.
inline constexpr std::string_view k_camera_uniform = "iCamera";
inline constexpr std::string_view k_orbit_uniform = "iOrbit";
inline constexpr std::string_view k_orbit_pan_uniform = "iOrbitPan";
inline constexpr std::string_view k_time_low_uniform = "iTimeLow";

/// Returns whether a scene must not use the name for a uniform of its own.
inline bool is_host_uniform(std::string_view name) {
    const auto is_name = [&](std::string_view taken) { return taken == name; };
    return std::ranges::any_of(k_site_uniforms, is_name, &SiteUniform::name) ||
           std::ranges::any_of(k_channel_names, is_name) || std::ranges::any_of(k_channel_structs, is_name) ||
           name == k_camera_uniform || name == k_time_low_uniform || name == k_mouse_button_uniform ||
           name == k_view_uniform || name == k_orbit_uniform || name == k_orbit_pan_uniform ||
           name == "iChannel" || name == "iKeyboard" || name.starts_with("tidemark_");
}

} // namespace tidemark::scene
