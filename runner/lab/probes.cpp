#include "lab/probes.hpp"

#include <algorithm>

namespace tidemark::lab {

std::string_view to_string(Verdict verdict) {
    switch (verdict) {
    case Verdict::pass: return "pass";
    case Verdict::note: return "note";
    case Verdict::warn: return "warn";
    case Verdict::fail: return "fail";
    case Verdict::not_applicable: return "n/a";
    case Verdict::cut: return "cut";
    }
    return {};
}

bool is_finding(Verdict verdict) {
    return verdict == Verdict::note || verdict == Verdict::warn || verdict == Verdict::fail;
}

void add_place(Answer& answer, SourceLocation where) {
    where.column = 0;
    if (!where.file.empty() && std::ranges::find(answer.places, where) == answer.places.end())
        answer.places.push_back(std::move(where));
}

namespace {

constexpr PlainWords k_not_finite{Family::numbers, "some pixels are NaN or infinite", "", Remedy::fix};

} // namespace

std::span<const Probe> all_probes() {
    static constexpr Probe probes[] = {
        {"times",
         "NaN or infinity in any pass, at 0, 1e-6 and 1 s, around 62.83 s, to 1e6 s, at 2^24 and -5 s",
         ask_times, k_not_finite},
        {"frames", "NaN or infinity in any pass in the first 600 frames of a scene with feedback", ask_frames,
         k_not_finite},
        {"no_nan",
         "proof from the text that no operation leaves its domain, in all pixels, over a span of time and "
         "all knob values",
         ask_no_nan},
        {"mouse", "NaN or infinity with the mouse in corners, at edges, outside, pressed, dragged, released",
         ask_mouse, k_not_finite},
        {"sizes", "NaN or infinity at 1x1, 1x64, 64x1, odd sizes and the widest the driver has", ask_sizes,
         k_not_finite},
        {"inputs",
         "NaN or infinity with each input of any pass unbound, black, white, one texel or noise; how far a "
         "NaN in it spreads",
         ask_inputs, k_not_finite},
        {"knobs", "NaN or infinity with each knob at both ends and in the middle of its range", ask_knobs,
         k_not_finite},
        {"hashes",
         "random numbers from large sines or products, which differ from one GPU to the next",
         ask_hashes,
         {Family::sines, "random numbers differ from one GPU to the next", "sin() of a large number",
          Remedy::fix_hashes}},
        {"unassigned",
         "variables, members and `out` parameters that some path leaves without a value; missing returns",
         ask_unassigned,
         {Family::alone, "some hosts draw garbage",
          "a variable is read before it has a value, which is 0 here and on ShaderToy's site only",
          Remedy::fix}},
        {"divergence",
         "derivatives and mipmap choices where neighbouring pixels may have taken another branch",
         ask_divergence,
         {Family::alone, "GPUs may draw seams",
          "a texture or derivative is read where neighbouring pixels may have taken another branch",
          Remedy::fix}},
        {"counters",
         "loops that count in floats and run more or fewer iterations than written",
         ask_counters,
         {Family::alone, "a loop runs more or fewer times than its numbers say",
          "its float counter is rounded at each step", Remedy::fix}},
        {"edges",
         "clamp with its low limit above its high one, smoothstep with reversed or equal edges",
         ask_edges,
         {Family::garbage, "the result is undefined in GLSL, and may differ on other GPUs",
          "the edges of clamp or smoothstep are in the wrong order, or equal", Remedy::fix}},
        {"seams",
         "lines where a texture's coordinates jump and a mipmap is chosen across the jump",
         ask_seams,
         {Family::alone, "a thin line shows in the picture",
          "the texture's coordinates jump there, and its mipmap is chosen across the jump", Remedy::fix}},
        {"loops",
         "loops that this driver ends before they are done (llvmpipe: after 65535 iterations)",
         ask_loop_ends,
         {Family::alone, "the picture is wrong on this device", "the driver ends a loop before it is done",
          Remedy::show}},
        {"repeats",
         "the same inputs give the same bytes: drawn again, after other frames, recompiled",
         ask_repeats,
         {Family::garbage, "the same frame is drawn differently from time to time", "", Remedy::show}},
        {"tiles",
         "a picture drawn in tiles, as large ones are, has the same bytes as one drawn whole",
         ask_tiles,
         {Family::garbage, "a picture that is drawn in tiles, as large ones are, has other pixels", "",
          Remedy::show}},
        {"threads",
         "one thread draws the same bytes as many",
         ask_threads,
         {Family::garbage, "the picture depends on the number of threads that draw it", "", Remedy::show}},
        {"first_hit",
         "rays that step over their first hit or miss it, proved from the text",
         ask_first_hit,
         {Family::steps, "rays step through surfaces, so thin parts have holes",
          "the march's steps are too long", Remedy::fix}},
        {"step_scale",
         "the longest step, as a multiple of the distance, that passes no first hit, proved from the text",
         ask_step_scale,
         {Family::steps, "rays could step through surfaces", "the march's steps are longer than is safe",
          Remedy::fix}},
        {"turns",
         "rays that run out of the march loop's iterations, and the iterations that they need, proved from "
         "the text",
         ask_turns,
         {Family::iterations, "rays run out of iterations before they hit anything", "", Remedy::fix}},
        {"drift",
         "whether mainHit agrees with the march of mainImage, recorded while it runs (mainHit)",
         ask_drift,
         {Family::alone, "mainHit and mainImage disagree about what rays hit", "", Remedy::show}},
        {"overstep",
         "rays with a sample below the surface: proof that a step was too long (hits)",
         ask_overstep,
         {Family::steps, "rays take samples below the surface", "the march's steps are too long",
          Remedy::fix}},
        {"budget",
         "rays that run out of steps (hits)",
         ask_budget,
         {Family::iterations, "rays run out of iterations before they hit anything", "", Remedy::fix}},
        {"gradient",
         "the largest slope of the field found along a ray, and the bound that the scene states (hits)",
         ask_gradient,
         {Family::steps, "the distance falls faster than the scene states",
          "steps that rely on the stated slope are too long", Remedy::show}},
        {"lipschitz_sweep",
         "rays with a sample below the surface, and NaN distances, with each knob, height and scale at 0, "
         "1/2, 2 and 4 times its value, and each knob at its ends (hits)",
         ask_lipschitz_sweep,
         {Family::steps, "rays take samples below the surface with other settings",
          "the march's steps are too long", Remedy::show}},
        {"grazing",
         "rays that run out of steps along the horizon, at all mouse heights that show it, and exactly level "
         "rays (hits)",
         ask_grazing,
         {Family::iterations, "rays along the horizon run out of iterations", "", Remedy::show}},
        {"far",
         "flicker when the far plane moves by a thousandth (hits; knob far_distance, or the definition that "
         "limits the march)",
         ask_far,
         {Family::alone, "the picture flickers when the far plane moves a little", "", Remedy::show}},
        {"self_intersection",
         "waves whose steepness adds up to 0.75, 0.99, 1 and 1.5: from 1 on crests intersect themselves "
         "(hits, knob "
         "of a steepness)",
         ask_self_intersection,
         {Family::alone, "steep waves intersect themselves", "", Remedy::show}},
        {"octaves",
         "the fewest and the most octaves that the scene allows: coordinates beyond float precision (hits)",
         ask_octaves,
         {Family::alone, "the finest octaves are rounded away", "their coordinates are too large for floats",
          Remedy::show}},
        {"mouse_edge",
         "a click in the first column or row that is not taken as a click",
         ask_mouse_edge,
         {Family::alone, "a click in the first column or row is not taken as a click", "", Remedy::show}},
        {"camera",
         "jumps of the picture under a one-pixel step of the mouse, up and across; NaN at a pole",
         ask_camera,
         {Family::alone, "the picture jumps when the mouse moves by one pixel", "", Remedy::show}},
        {"time_discontinuity",
         "jumps of the picture in time, tried at every number in the text",
         ask_time_discontinuity,
         {Family::alone, "the picture jumps in time", "", Remedy::show}},
        {"horizon",
         "how long float and double agree, to 1/255 in 99 % of the pixels",
         ask_horizon,
         {Family::clock, "the picture changes through rounding", "floats have too few digits for it",
          Remedy::fix}},
        {"rays",
         "how long rays hit the same place in float and double, to a pixel's width in 99 % (hits)",
         ask_rays,
         {Family::clock, "rays hit other places than they should", "floats have too few digits for the time",
          Remedy::fix}},
        {"epsilon",
         "rays that run out of steps in float but not in double: the hit threshold is below float rounding "
         "(hits)",
         ask_epsilon,
         {Family::iterations, "rays run out of iterations before they hit anything",
          "the hit threshold is smaller than the rounding of floats", Remedy::fix}},
        {"places",
         "the camera below the surface, high above, and 10 to 1e6 units away: finite, and the same in float "
         "and double (hits, iCamera or knob camera_position)",
         ask_places,
         {Family::alone, "rays go wrong when the camera is far away or below the surface", "", Remedy::show}},
        {"normals",
         "slopes by differences of the field over 0.1 to 1e-6, float compared with double (mainHit, "
         "march_field)",
         ask_normals,
         {Family::alone, "shading shows facets",
          "the differences for normals are taken over a step of the wrong size", Remedy::show}},
        {"search",
         "NaN or infinity at random times, knob values and mouse positions and at numbers from the text, "
         "then towards the edges of functions' domains",
         ask_search, k_not_finite},
        {"undefined",
         "undefined results that show in the picture: pow of a negative number, sqrt, log or acos outside "
         "its domain, normalize of a zero vector, smoothstep with equal edges, mod by 0, 0 / 0",
         ask_undefined,
         {Family::numbers, "other GPUs may draw other pixels", "a function is called outside of its domain",
          Remedy::fix}},
        {"bounds",
         "indices outside an array, shifts by 32 and more, integers divided by 0, texels outside a texture, "
         "floats outside the range of an int, as far as the search finds them",
         ask_bounds,
         {Family::garbage, "other GPUs may draw garbage",
          "an index, shift, divisor, texel or conversion is out of range", Remedy::show}},
        {"sine",
         "visible change (1/255 in 1 % of the pixels) if sines and cosines are a unit in the last place off, "
         "or rounded as on NVIDIA's GPUs",
         ask_sine,
         {Family::sines, "GPUs draw different pictures",
          "the picture depends on the last digits of sin() and cos()", Remedy::show}},
        {"rounding",
         "visible change with other roundings: inputs a unit larger, everything `precise`, fused "
         "multiply-add, sums in reverse order, quotients, roots, powers and logarithms a unit off",
         ask_rounding,
         {Family::sines, "GPUs draw different pictures",
          "the picture depends on how sums and products are rounded", Remedy::show}},
        {"mediump",
         "visible change with every + - * / in half floats, where the text says `mediump` or `lowp`",
         ask_mediump,
         {Family::alone, "phones draw another picture", "`mediump` and `lowp` numbers have few digits there",
          Remedy::show}},
    };
    return probes;
}

} // namespace tidemark::lab
