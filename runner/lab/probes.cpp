#include "lab/probes.hpp"

namespace tidemark::lab {

std::string_view to_string(Verdict verdict) {
    switch (verdict) {
    case Verdict::pass: return "pass";
    case Verdict::warn: return "warn";
    case Verdict::fail: return "fail";
    case Verdict::not_applicable: return "n/a";
    case Verdict::cut: return "cut";
    }
    return {};
}

std::span<const Probe> all_probes() {
    static constexpr Probe probes[] = {
        {"times",
         "NaN or infinity in any pass, at 0, 1e-6 and 1 s, around 62.83 s, to 1e6 s, at 2^24 and -5 s",
         ask_times},
        {"frames", "NaN or infinity in any pass in the first 600 frames of a scene with feedback",
         ask_frames},
        {"no_nan",
         "proof from the text that no operation leaves its domain, in all pixels, over a span of time and "
         "all knob values",
         ask_no_nan},
        {"mouse", "NaN or infinity with the mouse in corners, at edges, outside, pressed, dragged, released",
         ask_mouse},
        {"sizes", "NaN or infinity at 1x1, 1x64, 64x1, odd sizes and the widest the driver has", ask_sizes},
        {"inputs",
         "NaN or infinity with each input of any pass unbound, black, white, one texel or noise; how far a "
         "NaN in it spreads",
         ask_inputs},
        {"knobs", "NaN or infinity with each knob at both ends and in the middle of its range", ask_knobs},
        {"hashes", "random numbers from large sines or products, which differ from one GPU to the next",
         ask_hashes},
        {"unassigned",
         "variables, members and `out` parameters that some path leaves without a value; missing returns",
         ask_unassigned},
        {"divergence",
         "derivatives and mipmap choices where neighbouring pixels may have taken another branch",
         ask_divergence},
        {"counters", "loops that count in floats and run more or fewer iterations than written",
         ask_counters},
        {"loops", "loops that this driver ends before they are done (llvmpipe: after 65535 iterations)",
         ask_loop_ends},
        {"repeats", "the same inputs give the same bytes: drawn again, after other frames, recompiled",
         ask_repeats},
        {"tiles", "a picture drawn in tiles, as large ones are, has the same bytes as one drawn whole",
         ask_tiles},
        {"threads", "one thread draws the same bytes as many", ask_threads},
        {"first_hit", "rays that step over their first hit or miss it, proved from the text", ask_first_hit},
        {"step_scale",
         "the longest step, as a multiple of the distance, that passes no first hit, proved from the text",
         ask_step_scale},
        {"turns",
         "rays that run out of the march loop's iterations, and the iterations that they need, proved from "
         "the text",
         ask_turns},
        {"drift", "whether mainHit agrees with the march of mainImage, recorded while it runs (mainHit)",
         ask_drift},
        {"overstep", "rays with a sample below the surface: proof that a step was too long (hits)",
         ask_overstep},
        {"budget", "rays that run out of steps (hits)", ask_budget},
        {"gradient",
         "the largest slope of the field found along a ray, and the bound that the scene states (hits)",
         ask_gradient},
        {"lipschitz_sweep",
         "rays with a sample below the surface, and NaN distances, with each knob, height and scale at 0, "
         "1/2, 2 and 4 times its value, and each knob at its ends (hits)",
         ask_lipschitz_sweep},
        {"grazing",
         "rays that run out of steps along the horizon, at all mouse heights that show it, and exactly level "
         "rays (hits)",
         ask_grazing},
        {"far",
         "flicker when the far plane moves by a thousandth (hits; knob far_distance, or the definition that "
         "limits the march)",
         ask_far},
        {"self_intersection",
         "waves whose steepness adds up to 0.75, 0.99, 1 and 1.5: from 1 on crests intersect themselves "
         "(hits, knob "
         "of a steepness)",
         ask_self_intersection},
        {"octaves",
         "the fewest and the most octaves that the scene allows: coordinates beyond float precision (hits)",
         ask_octaves},
        {"mouse_edge", "a click in the first column or row that is not taken as a click", ask_mouse_edge},
        {"camera", "jumps of the picture under a one-pixel step of the mouse, up and across; NaN at a pole",
         ask_camera},
        {"time_discontinuity", "jumps of the picture in time, tried at every number in the text",
         ask_time_discontinuity},
        {"horizon", "how long float and double agree, to 1/255 in 99 % of the pixels", ask_horizon},
        {"rays", "how long rays hit the same place in float and double, to a pixel's width in 99 % (hits)",
         ask_rays},
        {"epsilon",
         "rays that run out of steps in float but not in double: the hit threshold is below float rounding "
         "(hits)",
         ask_epsilon},
        {"places",
         "the camera below the surface, high above, and 10 to 1e6 units away: finite, and the same in float "
         "and double (hits, iCamera or knob camera_position)",
         ask_places},
        {"normals",
         "slopes by differences of the field over 0.1 to 1e-6, float compared with double (mainHit, "
         "march_field)",
         ask_normals},
        {"search",
         "NaN or infinity at random times, knob values and mouse positions and at numbers from the text, "
         "then towards the edges of functions' domains",
         ask_search},
        {"undefined",
         "undefined results that show in the picture: pow of a negative number, sqrt, log or acos outside "
         "its domain, normalize of a zero vector, smoothstep with equal edges, mod by 0, 0 / 0",
         ask_undefined},
        {"bounds",
         "indices outside an array, shifts by 32 and more, integers divided by 0, texels outside a texture, "
         "floats outside the range of an int, as far as the search finds them",
         ask_bounds},
        {"sine",
         "visible change (1/255 in 1 % of the pixels) if sines and cosines are a unit in the last place off, "
         "or rounded as on NVIDIA's GPUs",
         ask_sine},
        {"rounding",
         "visible change with other roundings: inputs a unit larger, everything `precise`, fused "
         "multiply-add, sums in reverse order, quotients, roots, powers and logarithms a unit off",
         ask_rounding},
        {"mediump",
         "visible change with every + - * / in half floats, where the text says `mediump` or `lowp`",
         ask_mediump},
    };
    return probes;
}

} // namespace tidemark::lab
