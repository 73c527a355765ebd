// Cameras: from a pixel to a ray.
#ifndef LIB_CAMERA
#define LIB_CAMERA

// Axes of a camera, as columns: right, up, forward. Yaw 0 looks along +z. Right is cross(forward, y) made unit
// by hand, so that it is defined straight up and down as well; beyond these the world stands on its head.
mat3 camera_axes(float yaw, float pitch) {
    vec3 forward = vec3(sin(yaw) * cos(pitch), sin(pitch), cos(yaw) * cos(pitch));
    vec3 right = vec3(-cos(yaw), 0.0, sin(yaw));
    return mat3(right, cross(right, forward), forward);
}

// Yaw and pitch of a camera that the mouse turns: `turned` 0..1 is the mouse in parts of the picture, `ranges` the
// radians of yaw across its width and of pitch up its height, half of each to either side of a level look.
vec2 mouse_angles(vec2 turned, vec2 ranges) {
    return ranges * (clamp(turned, 0.0, 1.0) - 0.5);
}

// That camera. Straight up and straight down it rests.
mat3 mouse_camera(vec2 turned, vec2 ranges) {
    vec2 angles = mouse_angles(turned, ranges);
    return camera_axes(angles.x, clamp(angles.y, -1.57079632, 1.57079632));
}

// The mouse in parts of the picture; `untouched` while it is at (0, 0), where it is before its first click.
vec2 mouse_turn(vec2 untouched) {
    return iMouse.x == 0.0 && iMouse.y == 0.0 ? untouched : iMouse.xy / iResolution.xy;
}

// Unit direction of the ray through a pixel. The picture is 1 high at the distance `focal_length`.
vec3 pixel_ray(mat3 axes, vec2 frag_coord, float focal_length) {
    vec2 at = (frag_coord - 0.5 * iResolution.xy) / iResolution.y;
    return axes * normalize(vec3(at, focal_length));
}

// Width of a pixel at distance 1, world units: at most, as it shrinks away from the middle of the picture.
float pixel_width(float focal_length) {
    return 1.0 / (iResolution.y * focal_length);
}
#endif
