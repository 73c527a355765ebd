// A scene's own view, moved by the host's orbit camera: a drag turns it, the wheel goes nearer, the middle button
// pans, R goes back. With --mouse alone and on other hosts the mouse stays the scene's own.
#ifndef LIB_ORBIT
#define LIB_ORBIT

#include "camera.glsl"

// Filled by Tidemark where a text declares them; elsewhere all is 0. x, y: radians of azimuth and elevation that
// people turned the camera by; z: its distance in parts of the first; w: 1 where people move it, else 0.
uniform vec4 iOrbit;
// The place that it turns around, in first distances: right, up and backwards, of the first view made level.
uniform vec3 iOrbitPan;

// Whether people move the camera; else, or where a scene's knob `document_mouse` asks for that, it is iMouse's.
bool orbits(int document_mouse) {
    return document_mouse == 0 && iOrbit.w > 0.0;
}

// What the place was moved by that a camera of that yaw looks at from `distance`: as far as the pointer over it.
vec3 orbit_pan(float yaw, float distance, float focal_length) {
    return distance / focal_length * camera_axes(yaw, 0.0) * vec3(iOrbitPan.xy, -iOrbitPan.z);
}

// A camera: where it stands, and its axes as columns: right, up, forward.
struct View {
    vec3 position;
    mat3 axes;
};

// The view of a scene whose camera stands at `position` over a sea at y = 0 and is turned by iMouse as mouse_camera()
// has it; or, where people move it, around the place of the sea that the middle of its first picture shows. Instead
// of going below `lowest` it stays there and looks up.
View sea_view(int document_mouse, vec3 position, vec2 default_turn, vec2 ranges, float focal_length, float lowest) {
    if (!orbits(document_mouse)) {
        return View(position, mouse_camera(mouse_turn(default_turn), ranges));
    }
    vec2 angles = mouse_angles(default_turn, ranges);
    vec3 forward = mouse_camera(default_turn, ranges)[2];
    mat3 axes = camera_axes(angles.x + iOrbit.x, clamp(angles.y - iOrbit.y, -1.57079632, 1.57079632));
    float distance = clamp(position.y / max(-forward.y, 1e-3), 1.0, 50.0);
    vec3 moved = position + distance * (forward - iOrbit.z * axes[2]) + orbit_pan(angles.x, distance, focal_length);
    moved.y = max(moved.y, min(position.y, lowest));
    return View(moved, axes);
}
#endif
