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
        {"frames",
         "NaN or infinity in any pass in the first 600 frames, drawn one after the other (a pass that reads "
         "what it drew)",
         ask_frames},
        {"no_nan",
         "whether any operation can leave its domain, in all pixels, over a span of time and the knobs' "
         "ranges "
         "at once: value ranges from the text",
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
        {"unassigned", "variables, members and `out` that some path leaves without a value, missing returns",
         ask_unassigned},
        {"divergence",
         "derivatives, and textures that choose a mipmap, where neighbouring pixels may have taken "
         "another branch",
         ask_divergence},
        {"counters",
         "loops that count by steps of a float, and turn more or less often than their numbers say",
         ask_counters},
        {"repeats", "the same inputs give the same bytes: again, after other frames, compiled anew",
         ask_repeats},
        {"tiles", "a picture drawn in tiles, as large ones are, has the bytes of the picture drawn whole",
         ask_tiles},
        {"threads", "one thread draws the same bytes as many", ask_threads},
        {"first_hit",
         "rays whose march steps over their first hit or misses it, proved from the text: intervals bound "
         "the field between the samples",
         ask_first_hit},
        {"step_scale",
         "by what multiple of the distance a step may be long and go past no first hit, wherever it is "
         "taken, "
         "proved from the text; and the longest of the march's own",
         ask_step_scale},
        {"turns",
         "rays that run out of the turns of their march's loop; and bounds of the turns that they need, "
         "proved "
         "from the text by how far each step goes at least",
         ask_turns},
        {"drift", "whether mainHit says what mainImage's own march does, recorded while it runs (mainHit)",
         ask_drift},
        {"overstep", "rays with a sample below the surface: proof that a step was too long (hits)",
         ask_overstep},
        {"budget", "rays that run out of steps (hits)", ask_budget},
        {"gradient",
         "the largest slope of the field along a ray, sampled and climbed to, beside the bound that the "
         "scene states (hits)",
         ask_gradient},
        {"lipschitz_sweep",
         "rays with a sample below the surface, and distances that are NaN, with each knob at both ends, at "
         "0, 1/2, 2 and 4 times "
         "its value within its range, and with defined heights and scales so (hits)",
         ask_lipschitz_sweep},
        {"grazing",
         "rays that run out of steps along the horizon, at all mouse heights that show it, and in exactly "
         "level rays (hits)",
         ask_grazing},
        {"far",
         "flicker before a far plane that moves by a thousandth (hits; knob far_distance, or the definition "
         "that limits the march)",
         ask_far},
        {"self_intersection",
         "waves whose steepness adds up to 0.75, 0.99, 1 and 1.5: from 1 on crests intersect themselves "
         "(hits, knob "
         "of a steepness)",
         ask_self_intersection},
        {"octaves",
         "as few and as many octaves as the scene allows: coordinates beyond what floats hold (hits)",
         ask_octaves},
        {"mouse_edge",
         "a click in the first column or row that is taken for none, and shows another view than the next",
         ask_mouse_edge},
        {"camera", "turns of the picture under a one-pixel step of the mouse, up and across; NaN at a pole",
         ask_camera},
        {"time_discontinuity",
         "cuts: an instant that is less like the next than before and after, at every number in the text",
         ask_time_discontinuity},
        {"horizon", "until when float and double agree, to 1/255 in 99 % of the pixels", ask_horizon},
        {"rays", "until when rays hit the same in float and double, to a pixel's width in 99 % (hits)",
         ask_rays},
        {"epsilon",
         "rays that run out of steps in float and not in double: they wait for a smaller value than "
         "rounding allows (hits)",
         ask_epsilon},
        {"places",
         "the camera below the surface, high above, and 10 to 1e6 units away: finite, and the same in float "
         "and double (hits, iCamera or knob camera_position)",
         ask_places},
        {"normals",
         "slopes by differences of the field, in float against double, over 0.1 to 1e-6 (mainHit, "
         "march_field)",
         ask_normals},
        {"search",
         "NaN or infinity in moments, knobs and places of the mouse by lot and at the text's own numbers, "
         "then "
         "towards the edges of functions' domains and the other way of comparisons, and in single pixels of "
         "640x360",
         ask_search},
        {"undefined",
         "pow of a negative number, sqrt, log, acos and their kind outside of their domain, normalize of "
         "a zero vector, smoothstep with equal edges, mod by 0, 0 / 0: where the picture depends on what a "
         "GPU makes of it",
         ask_undefined},
        {"bounds",
         "indices outside of an array, shifts by 32 and more, whole numbers divided by 0, texels outside of "
         "a texture, floats outside of the range of an int, where the search came to them",
         ask_bounds},
        {"sine",
         "the picture with sines and cosines a unit in the last place up and down, and reduced and rounded "
         "as NVIDIA's: apart by more than 1/255 in 1 % of the pixels",
         ask_sine},
        {"rounding",
         "the picture with iTime, iResolution and iMouse a unit larger, with everything `precise`, with "
         "fused multiply-add, with sums added up from the other end, and with quotients, "
         "roots, powers and logarithms a unit off: apart by as much",
         ask_rounding},
        {"mediump",
         "the picture with every + - * / in half floats, where the text says `mediump` or `lowp`: apart by "
         "as much",
         ask_mediump},
    };
    return probes;
}

} // namespace tidemark::lab
