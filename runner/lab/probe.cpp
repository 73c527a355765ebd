#include "lab/probe.hpp"

#include "lab/probes.hpp"

namespace tidemark::lab {

std::string_view to_string(Verdict verdict) {
    switch (verdict) {
    case Verdict::pass: return "pass";
    case Verdict::warn: return "warn";
    case Verdict::fail: return "fail";
    case Verdict::not_applicable: return "n/a";
    }
    return {};
}

std::span<const Probe> all_probes() {
    static constexpr Probe probes[] = {
        {"times",
         "NaN or infinity in any pass, at 0, 1e-6 and 1 s, around 62.83 s, to 1e6 s, at 2^24 and -5 s",
         ask_times},
        {"mouse", "NaN or infinity with the mouse in corners, at edges, outside, held down", ask_mouse},
        {"sizes", "NaN or infinity at 1x1, 1x64, 64x1, odd sizes and the widest the driver has", ask_sizes},
        {"inputs",
         "NaN or infinity with each input of Image unbound, black, white, one texel or noise; how far a NaN "
         "in it "
         "spreads",
         ask_inputs},
        {"knobs", "NaN or infinity with each knob at both ends and in the middle of its range", ask_knobs},
        {"hashes", "random numbers from large sines or products, which differ from one GPU to the next",
         ask_hashes},
        {"unassigned", "variables that are read before they have a value, `out` that never get one",
         ask_unassigned},
        {"undefined",
         "pow of a negative number, sqrt, log, acos and their kind outside of their domain, normalize of "
         "nothing, smoothstep with equal edges, mod by 0: where the picture hangs on what a GPU makes of it",
         ask_undefined},
        {"repeats", "the same inputs give the same bytes: again, after other frames, compiled anew",
         ask_repeats},
        {"horizon", "until when float and double show the same, to 1/255 in 99 % of the pixels", ask_horizon},
        {"sine",
         "the picture with sines and cosines a unit in the last place up and down, and reduced and rounded "
         "as NVIDIA's: apart by more than 1/255 in 1 % of the pixels",
         ask_sine},
        {"rounding",
         "the picture with iTime, iResolution and iMouse a unit larger, with everything `precise`, and with "
         "every second + - * / a unit off, as contracting and reordering do: apart by as much",
         ask_rounding},
        {"witnesses", "rays with a sample below the surface: proof that a step was too long (mainHit)",
         ask_witnesses},
        {"budget", "rays that run out of steps (mainHit)", ask_budget},
        {"stiffness", "the same, and distances that are no number, with each knob at both ends (mainHit)",
         ask_stiffness},
        {"camera", "turns of the picture under a one-pixel step of the mouse", ask_camera},
        {"jumps",
         "cuts: an instant that is less like the next than before and after, at every number in the text",
         ask_jumps},
    };
    return probes;
}

} // namespace tidemark::lab
