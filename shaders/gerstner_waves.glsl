// Gerstner waves: four trains of F. J. von Gerstner's trochoidal waves (1804), whose water runs round in
// circles, so that crests are sharp and troughs are wide.
//
// The scene is that of the Unity shader "Custom/OceanWave": its four waves (10, 5, 3 and 7 m long, towards 0,
// 45, 90 and 135 degrees), a normal from the crossed tangents with a noise picture's normals on top, foam where
// the surface is steep times a foam picture, Fresnel to the 4th power, a smoothness that foam takes away, and
// two pictures that slide. That shader moves the points of a mesh; here each pixel's ray is marched, so the
// movement has to be undone: the height over a place is that of the water which the waves have carried there,
// found with I. Newton's method. The text is new; the pictures, which the author had lost, are made of noise,
// and the sky and the light from below are ours.
//
//     stage                 function             document's name
//     a wave                displace, trains     GerstnerWave
//     height over a place   unmoved, height      (vert moves a mesh)
//     normal                wave_normal          cross(binormal, tangent)
//     detail                ripple_tilt          UnpackNormal(_NoiseTex)
//     foam, smoothness      surface              surf
//
// Lengths are metres, times seconds, angles radians, colours 0..1 before `gamma`. The mouse turns the view; while
// it is at (0,0), where it is before its first click, the view is `default_turn`.
//
// Knobs that are compiled in:
#define SOLVER MARCH_BRACKET // one of lib/march.glsl's, but for MARCH_SEGMENT; its slope bound is proved here
#define MAX_STEPS 512         // field samples along a ray
#define HIT_DISTANCE 0.001 // MARCH_SPHERE: value of the field that counts as touching
#define FIXED_STEP 0.25    // MARCH_FIXED: distance of its samples; wants MAX_STEPS to reach far_distance
#define NEWTON_STEPS 4     // 1..8; 4 leave 6e-14 of the movement before rounding, 3 leave 6e-7, 2 leave 2e-3
#define FOAM 1             // each of these 0: without, and none of its code is compiled
#define REFLECTION 1
#define FOG 1
#define CLOUDS 1
//
// Knobs that are uniforms. The four waves: length, steepness (height times 2 pi / length; where they add up to
// more than 0.95 all are lowered, for at 1 crests would fold over), speed in parts of what gravity gives a
// wave of that length, and direction, 0 towards +z and a quarter turn towards +x. The factors of all of them
// are the document's sliders, 1 at its values 0.5 and 1.2.
#iUniform vec4 wave_length = vec4(10.0, 5.0, 3.0, 7.0) in { 0.5, 40.0 }
#iUniform vec4 wave_steepness = vec4(0.3, 0.2, 0.1, 0.15) in { 0.0, 0.6 }
#iUniform vec4 wave_pace = vec4(1.2, 1.5, 2.0, 1.0) in { -4.0, 4.0 }
#iUniform vec4 wave_direction = vec4(0.0, 0.785, 1.57, 2.356) in { -3.1416, 3.1416 }
#iUniform float wave_scale = 0.5 in { 0.0, 2.0 }
#iUniform float wave_speed = 1.2 in { 0.0, 5.0 }
// camera: place, yaw and pitch before the mouse is used (parts of the ranges), their ranges, focal length; how
// far the water goes
#iUniform vec3 camera_position = vec3(0.0, 2.4, 0.0) in { -50.0, 50.0 }
#iUniform vec2 default_turn = vec2(0.4, 0.44) in { 0.0, 1.0 }
#iUniform float yaw_range = 6.2832 in { 0.0, 12.5664 }
#iUniform float pitch_range = 2.8 in { 0.0, 3.1 }
#iUniform float focal_length = 1.1 in { 0.3, 5.0 }
#iUniform float far_distance = 400.0 in { 10.0, 1000.0 }
// 1: iMouse turns the view, as in the document, instead of the host's camera
#iUniform int document_mouse = 0 in { 0, 1 }
// water: its colours and smoothness; repeats of the two pictures a metre, their movement in repeats a second;
// how much the noise tilts the surface
#iUniform color3 main_color = color3(0.1, 0.3, 0.6)
#iUniform color3 foam_color = color3(1.0, 1.0, 1.0)
#iUniform float gloss = 0.8 in { 0.0, 1.0 }
#iUniform vec2 noise_uv_speed = vec2(0.1, 0.1) in { -1.0, 1.0 }
#iUniform vec2 foam_uv_speed = vec2(0.1, 0.1) in { -1.0, 1.0 }
#iUniform float noise_tiling = 0.12 in { 0.005, 0.5 }
#iUniform float foam_tiling = 0.05 in { 0.005, 0.5 }
#iUniform float noise_strength = 0.7 in { 0.0, 2.0 }
// foam = clamp(slope * foam_gain - foam_level) * picture, slope = 1 - normal.y of waves foam_reach as high;
// exponent of the mirror's growth at a glancing look; light that comes up through the crests
#iUniform float foam_gain = 5.0 in { 0.0, 20.0 }
#iUniform float foam_level = 0.7 in { 0.0, 4.0 }
#iUniform float foam_reach = 2.6 in { 0.0, 6.0 }
#iUniform float fresnel_exponent = 4.0 in { 1.0, 8.0 }
#iUniform float crest_light = 0.35 in { 0.0, 2.0 }
// sky: the sun's place (yaw and height in radians), colours, cover of the clouds; density of the fog a metre;
// exponent of the encoded picture
#iUniform vec2 sun_place = vec2(-0.55, 0.35) in { -3.1416, 3.1416 }
#iUniform color3 sun_color = color3(1.0, 0.88, 0.7)
#iUniform color3 zenith_color = color3(0.13, 0.32, 0.62)
#iUniform color3 horizon_color = color3(0.66, 0.78, 0.86)
#iUniform float cloud_amount = 0.55 in { 0.0, 1.0 }
#iUniform float fog_density = 0.006 in { 0.0, 0.05 }
#iUniform float gamma = 0.4545 in { 0.2, 1.5 }
#iChannel0 "noise"
#iChannel1 "noise"

#include "lib/camera.glsl"
#include "lib/fresnel.glsl"
#include "lib/march.glsl"
#include "lib/orbit.glsl"
#include "lib/phase.glsl"
#include "lib/seascape.glsl"
#include "lib/sky.glsl"
#include "lib/specular.glsl"

// ---- The four waves of this frame -----------------------------------------------------------------------

// One wave a component. The water that rests at x is moved by sum (direction a cos f, a sin f), where
// f = k direction . x - phase.
vec4 train_x; // direction
vec4 train_z;
vec4 train_k; // radians a metre
vec4 train_s; // steepness
vec4 train_a; // height, metres
vec4 train_phase;
float steepness; // of all together, 0..0.95

void make_waves() {
    train_x = sin(wave_direction);
    train_z = cos(wave_direction);
    train_k = binary32(binary32(6.283185307) / binary32(max(wave_length, vec4(0.01))));
    train_s = abs(wave_steepness) * (wave_scale / 0.5);
    steepness = dot(train_s, vec4(1.0));
    train_s *= min(1.0, 0.95 / max(steepness, 0.95));
    steepness = min(steepness, 0.95);
    train_a = train_s / train_k;

    vec4 rate = rate_product(binary32(sqrt(rate_product(vec4(9.8), train_k))), wave_pace);
    rate = rate_product(rate, vec4(binary32(wave_speed) / binary32(1.2)));
    vec2 now = seconds();
    train_phase = vec4(phase(rate.x, now), phase(rate.y, now), phase(rate.z, now), phase(rate.w, now));
}

vec4 angles(vec2 rest) {
    return train_k * (train_x * rest.x + train_z * rest.y) - train_phase;
}

// Where the water rests that is now at `place`: the zero of rest + movement(rest) - place. The Jacobian of that
// is symmetric and its eigenvalues are at least 1 - steepness, so Newton's method has one zero to find and no
// way to divide by nothing.
vec2 unmoved(vec2 place) {
    vec2 rest = place;
    for (int i = 0; i < NEWTON_STEPS; ++i) {
        vec4 angle = angles(rest);
        vec4 along = train_a * cos(angle);
        vec4 squeeze = train_s * sin(angle);
        vec2 off = rest + vec2(dot(train_x, along), dot(train_z, along)) - place;
        float xx = 1.0 - dot(train_x * train_x, squeeze);
        float xz = -dot(train_x * train_z, squeeze);
        float zz = 1.0 - dot(train_z * train_z, squeeze);
        rest -= vec2(zz * off.x - xz * off.y, xx * off.y - xz * off.x) / (xx * zz - xz * xz);
    }
    return rest;
}

// |height| <= sum a; slope over the place <= S / sqrt(1 - S^2), S = steepness: with J the Jacobian above and
// w = J^-1 sum s cos f d the slope, w = sum s (cos f + sin f d.w) d, and so |w| <= S sqrt(1 + |w|^2).
float height(vec2 place) {
    return dot(train_a, sin(angles(unmoved(place))));
}

// ---- The ray --------------------------------------------------------------------------------------------

vec3 ray_origin;
vec3 ray_direction;
float ray_slope; // bound of the field's slope along the ray

// The height above the water over a proved bound of its slope in this direction: truly a distance.
float march_field(float t) {
    vec3 position = ray_origin + t * ray_direction;
    return (position.y - height(position.xz)) / ray_slope;
}

#if SOLVER == MARCH_CERTIFIED
vec2 march_clearance(float t) {
    return vec2(march_field(t)); // a proof as it is
}
#endif

// The ray through a pixel, and the distance of the water on it; -1: none.
float look(vec2 frag_coord) {
    make_waves();
    float highest = dot(train_a, vec4(1.0));
    View view = sea_view(document_mouse, camera_position, default_turn, vec2(yaw_range, pitch_range), focal_length,
                         highest + 0.3);
    ray_origin = view.position;
    ray_direction = pixel_ray(view.axes, frag_coord, focal_length);
    float steepest = steepness / sqrt(1.0 - steepness * steepness);
    ray_slope = abs(ray_direction.y) + steepest * length(ray_direction.xz);

    // The noise: of a sine of some hundred radians.
    MarchRange range = MarchRange(0.0, far_distance, pixel_width(focal_length), 2e-5);
    return march(clip_to_slab(range, ray_origin, ray_direction, -highest, highest));
}

// ---- Shading --------------------------------------------------------------------------------------------

// What is left of each wave's slope under a pixel that covers the length `footprint` of water along `away`: the
// Fourier transform of a Gaussian of that size.
vec4 waves_left(vec2 away, float footprint) {
    vec4 across = train_k * footprint * (train_x * away.x + train_z * away.y);
    return exp(-0.5 * across * across);
}

// Unit normal from tangent and binormal of the moved water.
vec3 wave_normal(vec2 rest, vec4 left) {
    vec4 angle = angles(rest);
    vec4 rise = left * train_s * cos(angle);
    vec4 squeeze = left * train_s * sin(angle);
    float shear = -dot(train_x * train_z, squeeze);
    vec3 tangent = vec3(1.0 - dot(train_x * train_x, squeeze), dot(train_x, rise), shear);
    vec3 binormal = vec3(shear, dot(train_z, rise), 1.0 - dot(train_z * train_z, squeeze));
    return normalize(cross(binormal, tangent));
}

const float k_texels = 256.0; // of both pictures, a repeat

// Mipmap level of a picture for a pixel `footprint` repeats wide.
float level_of(float footprint) {
    return log2(max(footprint * k_texels, 1.0));
}

// The tilt that the noise picture gives the surface, as the document's normal map would: three scales of it.
vec2 ripple_tilt(vec2 place, float footprint) {
    vec2 drift = vec2(fract_of_product(noise_uv_speed.x, seconds()), fract_of_product(noise_uv_speed.y, seconds()));
    vec2 tilt = vec2(0.0);
    float scale = noise_tiling;
    for (int i = 0; i < 3; ++i) {
        vec2 uv = scale * place + drift;
        float level = level_of(scale * footprint);
        vec2 e = vec2(exp2(level) / k_texels, 0.0);
        tilt += vec2(textureLod(iChannel0, uv + e.xy, level).r - textureLod(iChannel0, uv - e.xy, level).r,
                     textureLod(iChannel0, uv + e.yx, level).r - textureLod(iChannel0, uv - e.yx, level).r) /
                (1.0 + 2.0 * level);
        scale *= 0.37;
        drift = -drift.yx;
    }
    return noise_strength * tilt;
}

#if FOAM
// A layer of the foam picture, `scale` times as fine.
float foam_layer(vec2 place, float scale, float level) {
    vec2 speed = rate_product(vec2(scale), foam_uv_speed);
    vec2 drift = vec2(fract_of_product(speed.x, seconds()), fract_of_product(speed.y, seconds()));
    return textureLod(iChannel1, scale * foam_tiling * place + drift, level + log2(scale)).r;
}

// The foam picture, 0..1: a web, and rafts where it is dense.
float foam_picture(vec2 place, float footprint) {
    float level = level_of(foam_tiling * footprint);
    float dense = 0.6 * foam_layer(place, 0.5, level) + 0.25 * foam_layer(place, 1.7, level) +
                  0.15 * foam_layer(place, 4.3, level);
    float web = 1.0 - smoothstep(0.0, 0.06, abs(dense - 0.47));
    return max(0.8 * web, smoothstep(0.5, 0.62, dense));
}

// The document's 1 - normal.y is that of a normal map's frame and no slope of the water: all was foam alike. Here
// it is the water's own, as if the waves were `foam_reach` times as high.
float foam_at(vec3 normal, vec2 rest, float footprint) {
    float slope = 1.0 - normalize(vec3(foam_reach * normal.x, normal.y, foam_reach * normal.z)).y;
    return clamp(slope * foam_gain - foam_level, 0.0, 1.0) * foam_picture(rest, footprint);
}
#endif

Sky sky() {
    return Sky(zenith_color, horizon_color, sun_color, direction_of(sun_place), cloud_amount);
}

vec3 surface(float t, vec3 position) {
    // A pixel covers a stretch of water that grows with the glancing look.
    float pixel = t * pixel_width(focal_length);
    float glancing = 1.0 / max(-ray_direction.y, 0.02);
    vec2 away = normalize(ray_direction.xz + vec2(1e-9, 0.0));
    vec2 rest = unmoved(position.xz);
    vec4 left = waves_left(away, pixel * glancing);
    vec3 base = wave_normal(rest, left);

    // The picture's normal and the one of the map's own frame, halved: as normalize(noiseNormal + o.Normal) is.
    float detail = pixel * pow(glancing, 0.65);
    vec2 tilt = ripple_tilt(rest, detail);
    vec3 normal = normalize(base - 0.5 * vec3(tilt.x, 0.0, tilt.y));
    normal = seen_normal(normal, ray_direction, 0.1);

    float foam = 0.0;
#if FOAM
    foam = foam_at(base, rest, detail);
#endif
    float smoothness = gloss * (1.0 - foam);

    vec3 sun = direction_of(sun_place);
    float lit = max(dot(normal, sun), 0.0);
    vec3 ambient = 0.55 * mix(horizon_color, zenith_color, 0.5 + 0.5 * normal.y);
    vec3 color = mix(main_color, foam_color, foam) * (ambient + 0.7 * lit * sun_color);

    // Light that has come through the crest towards the eye.
    float crest = clamp(0.5 + 0.5 * position.y / max(dot(train_a, vec4(1.0)), 0.01), 0.0, 1.0);
    float through = pow(max(dot(ray_direction, normalize(sun - 0.6 * normal)), 0.0), 3.0);
    color += crest_light * crest * crest * (0.25 + through) * (1.0 - foam) * sqrt(main_color) * sun_color;

#if REFLECTION
    float mirror = fresnel(normal, ray_direction, fresnel_exponent) * smoothness;
    color = mix(color, sky_mirrored(sky(), ray_direction, normal), mirror);
#endif
    // Slopes too small to see still spread the sun's light: their variance adds to that of a highlight, which is
    // 2 / exponent.
    float unseen = 0.5 * dot(train_s * train_s, 1.0 - left * left) +
                   0.004 * noise_strength * level_of(noise_tiling * detail);
    float exponent = 2.0 / (2.0 / smooth_exponent(smoothness) + unseen);
    float highlight = smoothness * (0.006 * exponent + 0.05) * blinn_phong(normal, sun, -ray_direction, exponent);
    color += highlight * sun_color;
    return color;
}

#ifdef TIDEMARK_HIT
void mainHit(out vec4 hit, in vec2 fragCoord) {
    hit = march_report(look(fragCoord));
}
#endif

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float t = look(fragCoord);
    vec3 color = seascape(t, ray_origin, ray_direction);
    fragColor = vec4(pow(clamp(color, 0.0, 1.0), vec3(gamma)), 1.0);
}
