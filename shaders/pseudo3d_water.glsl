// Pseudo-3D water: a flat strip of noise bent into a sea by two curves and coloured by two small pictures.
//
// The method is that of "How to generate pseudo-3D water with a noise texture and some color ramps": the row
// of a pixel, 0 at the viewer's feet and 1 at the horizon, raised to the 8th power is the distance, so that
// rows crowd towards the horizon; its logarithm spreads the columns and lets what is near follow the
// viewer's place while the horizon stands; a second, larger layer of noise at another rate breaks the
// pattern; (lightness, distance) looks the colour up in a ramp; foam is the same water again at another
// rate through a ramp with transparency. The text is new, and so are the sky, the glitter and the noise's
// octaves.
//
// Only the upper part of the strip is shown. At row 0 the logarithm ends, at row 1/e all columns fall into
// one, at row 1 they are infinitely dense: so the picture's lowest row is `near_row` of the strip and its
// horizon stops short of 1 by `far_gap`. Both belong to the strip, not to the pixels: the sea has the same
// look at every size, and no pixel a logarithm or a quotient that is not finite.
//
// The mouse moves the viewer sideways (0 at the left edge, `parallax` at the right). A strip cannot be turned: with
// the host's camera the viewer walks on a circle, or to its middle and away, and goes on looking ahead; the horizon
// goes up and down as the look does.
//
// Knobs that are compiled in:
#define ROW_SAMPLES 2   // 1..8 looks down each pixel: rows crowd faster than columns, which a mipmap cannot say
#define NOISE_OCTAVES 5 // 1..8, each twice as fine
//
// place of things: part of the height that is water; the strip's first row, and how far its last stays from
// 1; noise repeats to the horizon; exponent of the distance; size of a repeat; the viewer's place
#iUniform float horizon = 0.62 in { 0.1, 1.0 }
#iUniform float near_row = 0.6 in { 0.4, 0.9 }
#iUniform float far_gap = 0.004 in { 0.0005, 0.05 }
#iUniform float horizon_distance = 5.0 in { 1.0, 20.0 }
#iUniform float distance_exponent = 8.0 in { 1.0, 16.0 }
#iUniform float main_scale = 0.22 in { 0.02, 1.0 }
#iUniform float viewer_x = 0.0 in { -10.0, 10.0 }
#iUniform float parallax = 1.0 in { -4.0, 4.0 }
// 1: iMouse moves the viewer, as in the document, instead of the host's camera
#iUniform int document_mouse = 0 in { 0, 1 }
// movement, in repeats a second to the left and towards the viewer: of the water, of the larger layer on top
// of that, of the foam
#iUniform vec2 move_speed = vec2(0.04, 0.14) in { -1.0, 1.0 }
#iUniform vec2 overlay_speed = vec2(0.15, 0.2) in { -1.0, 1.0 }
#iUniform vec2 foam_speed = vec2(0.07, 0.2) in { -1.0, 1.0 }
// look of the water: how much the light parts of the larger layer cover; contrast of the noise; cover of the
// foam; strength of the sun's glitter
#iUniform float overlay = 0.5 in { 0.0, 1.0 }
#iUniform float contrast = 1.8 in { 0.0, 6.0 }
#iUniform float foam = 0.8 in { 0.0, 1.0 }
#iUniform float glitter = 0.6 in { 0.0, 2.0 }
// sky: the sun's column (0 left, 1 right) and height above the horizon in heights of the picture; cover of the
// clouds and their movement in repeats a second; strength of the air before the horizon; colours as displayed
#iUniform float sun_column = 0.64 in { 0.0, 1.0 }
#iUniform float sun_height = 0.2 in { 0.0, 0.9 }
#iUniform float clouds = 0.7 in { 0.0, 1.0 }
#iUniform vec2 cloud_speed = vec2(0.02, 0.01) in { -1.0, 1.0 }
#iUniform float haze = 0.8 in { 0.0, 1.0 }
#iUniform color3 zenith_color = color3(0.16, 0.40, 0.68)
#iUniform color3 horizon_color = color3(0.76, 0.86, 0.90)
#iUniform color3 sun_color = color3(1.0, 0.93, 0.78)
#iChannel0 "noise"
#iChannel1 "../textures/water_ramp.png"
#iChannel1::WrapMode "Clamp"
#iChannel2 "../textures/foam_ramp.png"
#iChannel2::WrapMode "Clamp"

#include "lib/orbit.glsl"
#include "lib/phase.glsl"

// The noise picture has 256 texels a side and repeats; a repeat of the noise below has 8 of them across.
const float k_texels = 256.0;
const float k_cells = 8.0;

// White noise from the picture, smoothly interpolated: 0..1, one value a texel. `at` in texels.
float value_noise(vec2 at, vec2 dx, vec2 dy) {
    vec2 cell = floor(at - 0.5);
    vec2 part = at - 0.5 - cell;
    part *= part * (3.0 - 2.0 * part);
    return textureGrad(iChannel0, (cell + 0.5 + part) / k_texels, dx / k_texels, dy / k_texels).r;
}

// 0..1, about 1/2. Each octave is shifted so that no two have a lattice corner in one place.
float cloud(vec2 at, vec2 dx, vec2 dy) {
    float sum = 0.0;
    float weight = 0.5;
    float total = 0.0;
    for (int octave = 0; octave < NOISE_OCTAVES; ++octave) {
        sum += weight * value_noise(at, dx, dy);
        total += weight;
        weight *= 0.58;
        at = 2.0 * at + vec2(17.3, 43.7);
        dx *= 2.0;
        dy *= 2.0;
    }
    return sum / total;
}

// A shift by `speed` repeats a second, modulo the picture: as fine after a month as at the start.
vec2 drift(vec2 speed) {
    vec2 pictures = binary32(speed) * (k_cells / k_texels);
    return k_texels * vec2(fract_of_product(pictures.x, seconds()), fract_of_product(pictures.y, seconds()));
}

float stretch(float lightness) {
    return clamp(0.5 + contrast * (lightness - 0.5), 0.0, 1.0);
}

// Lightness of one sheet of water: the noise, and the larger noise laid over it where that one is light.
float sheet(vec2 at, vec2 dx, vec2 dy, vec2 speed) {
    float fine = stretch(cloud(at + drift(speed), dx, dy));
    vec2 broad_at = 0.25 * at + drift(0.25 * binary32(binary32(speed) + binary32(overlay_speed))) + 91.7;
    float broad = stretch(cloud(broad_at, 0.25 * dx, 0.25 * dy));
    return mix(fine, broad, overlay * broad);
}

float sun_x() {
    return (2.0 * sun_column - 1.0) * iResolution.x / iResolution.y * (9.0 / 16.0);
}

// ---- The viewer -----------------------------------------------------------------------------------------

const float k_reach = 2.0; // radius of the circle that a turn leads along

// Where the viewer stands: to the right, and ahead.
vec2 viewer() {
    if (!orbits(document_mouse)) {
        return vec2(viewer_x + parallax * iMouse.x / iResolution.x, 0.0);
    }
    vec3 pan = orbit_pan(0.0, 1.125, 1.0); // as fast as the pointer over the nearest row
    float half_chord = sin(0.5 * iOrbit.x);
    vec2 walked = vec2(iOrbit.z * sin(iOrbit.x), 1.0 - iOrbit.z + 2.0 * iOrbit.z * half_chord * half_chord);
    return vec2(viewer_x - pan.x, pan.z) + k_reach * walked;
}

// Part of the height that is water: more where the look goes down.
float skyline() {
    if (!orbits(document_mouse)) {
        return horizon;
    }
    return clamp(horizon + iOrbit.y / 3.14159265 - orbit_pan(0.0, 1.0, 1.0).y, 0.1, 1.0);
}

// A place on the strip in noise texels, with what a pixel across and a pixel up change it by.
struct Ground {
    vec2 at, dx, dy;
    float distance; // 0..1
};

// `x` -1..1 across a picture of 16:9; `row` 0..1 up the strip, `row_step` of it a pixel, `x_step` of x.
Ground ground_at(float x, float row, float x_step, float row_step) {
    float depth = -log(row); // 1 - (log(row) + 1)
    float spread = (1.0 - depth) / depth;
    vec2 here = viewer();
    float texels = k_cells / main_scale;

    Ground ground;
    ground.distance = pow(row, distance_exponent);
    ground.at = texels * vec2((x * spread + here.x) / horizon_distance,
                              ground.distance * horizon_distance + here.y / horizon_distance);
    ground.dx = texels * vec2(x_step * spread / horizon_distance, 0.0);
    ground.dy = texels * row_step *
                vec2(x / (depth * depth * row * horizon_distance),
                     distance_exponent * ground.distance / row * horizon_distance);
    return ground;
}

// Glitter on the crests below the sun, in a path that widens towards the viewer; `up` 0..1 of the strip.
vec3 glint(float x, float up, float lightness) {
    float width = mix(0.42, 0.10, up);
    float off = (x - sun_x()) / width;
    return glitter * mix(0.45, 1.0, up) * smoothstep(0.5, 0.95, lightness) * exp(-off * off) * sun_color;
}

vec3 water(float x, float up, float x_step, float up_step) {
    float strip = 1.0 - far_gap - near_row;
    vec3 color = vec3(0.0);
    for (int i = 0; i < ROW_SAMPLES; ++i) {
        float offset = (float(i) + 0.5) / float(ROW_SAMPLES) - 0.5;
        float row = near_row + strip * clamp(up + offset * up_step, 0.0, 1.0);
        Ground g = ground_at(x, row, x_step, strip * up_step / float(ROW_SAMPLES));

        float lightness = sheet(g.at, g.dx, g.dy, move_speed);
        vec3 surface = textureLod(iChannel1, vec2(lightness, g.distance), 0.0).rgb + glint(x, up, lightness);

        float froth = sheet(g.at + 57.0, g.dx, g.dy, foam_speed);
        vec4 cover = textureLod(iChannel2, vec2(froth, g.distance), 0.0);
        color += mix(surface, cover.rgb, foam * cover.a);
    }
    return color / float(ROW_SAMPLES);
}

// `up` from the horizon, in heights of the picture.
vec3 sky(float x, float up, float x_step, float up_step) {
    vec3 color = mix(horizon_color, zenith_color, 1.0 - exp(-2.6 * up));

    vec2 to_sun = vec2(x - sun_x(), (up - sun_height) * (9.0 / 8.0));
    float away = dot(to_sun, to_sun);
    color += sun_color * (0.28 * exp(-9.0 * away) + 0.5 * exp(-400.0 * away));

    // A flat sheet of cloud in true perspective, thinning towards the horizon where it would flicker.
    float near = 1.0 / (up + 0.09);
    vec2 at = 7.0 * vec2(x * near, near);
    vec2 dx = 7.0 * vec2(x_step * near, 0.0);
    vec2 dy = -7.0 * up_step * near * near * vec2(x, 1.0);
    float cover = smoothstep(0.46, 0.72, cloud(at + drift(cloud_speed), dx, dy)) * (1.0 - exp(-9.0 * up));
    return mix(color, vec3(0.97, 0.98, 0.99), clouds * cover);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord) {
    float aspect = iResolution.x / iResolution.y * (9.0 / 16.0);
    float x = (2.0 * fragCoord.x / iResolution.x - 1.0) * aspect;
    float up = fragCoord.y / iResolution.y;
    float x_step = 2.0 * aspect / iResolution.x;
    float up_step = 1.0 / iResolution.y;

    float level = skyline();
    vec3 color;
    if (up < level) {
        color = water(x, up / level, x_step, up_step / level);
    } else {
        color = sky(x, up - level, x_step, up_step);
    }
    // The air before the horizon, and the one row that is neither sea nor sky.
    color = mix(color, horizon_color, haze * exp(-abs(up - level) / 0.02));
    fragColor = vec4(clamp(color, 0.0, 1.0), 1.0);
}
