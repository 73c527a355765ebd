#include "lab/check/field_bench.hpp"

#include "glsl/hit.hpp"
#include "lab/check/rays.hpp"

#include <algorithm>

namespace tidemark::lab {

bool has_march_field(const scene::Scene& scene) {
    return scene.image().text.text().find("march_field") != std::string::npos;
}

Result<FieldBench> FieldBench::create(const scene::Scene& scene, const FieldQuestion& question,
                                      glsl::Precision precision) {
    scene::Scene asked = *glsl::hit_scene(scene);
    text::MappedText& text = asked.passes[asked.image_index()].text;
    text::MappedText whole;
    whole.append_generated("#define mainHit tidemark_own_hit\n");
    whole.append(text);
    whole.append_generated("#undef mainHit\n");
    whole.append_generated(question.hit);
    text = std::move(whole);
    const size_t first = asked.knobs.size();
    std::ranges::copy(question.knobs, std::back_inserter(asked.knobs));
    std::vector<scene::Knob> knobs = asked.knobs;
    auto made =
        render::Renderer::create(std::move(asked), {k_ray_extent, image::SampleType::f32, {}, precision});
    if (!made)
        return fail(std::move(made.error()));
    return FieldBench(*std::move(made), std::move(knobs), first);
}

image::Image FieldBench::ask(std::initializer_list<scene::KnobValue> values, const FrameState& state) {
    size_t knob = first_;
    for (const scene::KnobValue& value : values)
        knobs_[knob++].value = value;
    renderer_.turn(knobs_);
    renderer_.draw(inputs_of(state));
    return renderer_.read_back();
}

} // namespace tidemark::lab
