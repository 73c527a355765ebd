#include "cli/capture/run_fingerprint.hpp"

#include <nlohmann/json.hpp>

namespace tidemark::cli {
namespace {

Json knob_facts(const scene::Scene& scene) {
    Json facts = Json::array();
    for (const scene::Knob& knob : scene.knobs)
        facts.push_back(Json::array({knob.name, int(knob.type), knob.value}));
    return facts;
}

/// Leaves out size and pass, which belong to the frame, and tiles and trials without an allowed difference,
/// which do not change pictures.
Json drawing_facts(const CapturePlan& plan) {
    const auto& [extent, samples, pass, precision, specialise, extras, tile, marks, keeps_alpha] =
        plan.drawing;
    const bool differs = plan.trial && plan.trial->frames.allowed;
    Json facts = Json::array({int(samples), int(precision), int(specialise), marks, int(plan.depth),
                              plan.output.pattern().extension().string(), plan.output.six_faces(),
                              plan.output.video() ? Json(plan.pace.fps) : Json(),
                              differs ? Json(*plan.trial->frames.allowed) : Json()});
    if (plan.exposure.several())
        facts.push_back(Json::array({plan.exposure.samples, plan.exposure.shutter}));
    if (plan.transfer != drawn_transfer(pass))
        facts.push_back(Json::array({"transfer", int(plan.transfer)}));
    if (!plan.codec.empty())
        facts.push_back(Json::array({"codec", plan.codec}));
    if (plan.output.video() && plan.pace.holds)
        facts.push_back(Json::array({"ticks", ticks_of(plan.frames.frames, plan.pace)}));
    if (keeps_alpha)
        facts.push_back(Json::array({"alpha", int(plan.alpha)}));
    if (plan.layers)
        facts.push_back(Json::array({"layers", int(*plan.layers)}));
    return facts;
}

} // namespace

Fingerprint fingerprint_of_run(const CapturePlan& plan, const gl::Capabilities& driver) {
    Fingerprint run = Fingerprint::of_scene(plan.scene, plan.request.defines, plan.frames, driver);
    run.add("knobs", knob_facts(plan.scene));
    run.add("drawing", drawing_facts(plan));
    return run;
}

} // namespace tidemark::cli
