#include "lab/trace/stand_in.hpp"

#include "glsl/assemble.hpp"

#include <fmt/format.h>

namespace tidemark::lab {

Result<StandIn> StandIn::link(const PassPreview& preview, const std::string& text, std::string_view what,
                              std::optional<Extent> extent) {
    const auto version = preview.dialect().version;
    auto program = gl::Program::link(glsl::vertex_shader(version), text);
    if (!program)
        return fail(ErrorCode::load,
                    fmt::format("the driver refuses {}: {}", what, program.error().substr(0, 400)));
    auto target = gl::make_render_target(gl::make_texture(extent.value_or(preview.extent()), GL_RGBA32F, 1));
    if (!target)
        return fail(ErrorCode::load, fmt::format("the driver has no memory for the picture of {}", what));
    return StandIn(*std::move(program), *std::move(target));
}

void StandIn::set(const std::string& name, double value) {
    if (const gl::Uniform* uniform = program_.reflection().find(name))
        gl::set_uniform(program_, *uniform, std::span(&value, 1));
}

void StandIn::draw(const PassPreview& preview, int face) const {
    preview.draw(program_, target_, face);
}

void StandIn::draw_own(const PassPreview& preview) const {
    gl::clear(target_);
    preview.draw(preview.program(), target_);
}

image::Image StandIn::picture() const {
    image::Image image(target_.extent(), 4, image::SampleType::f32);
    gl::read_pixels(target_, GL_RGBA, GL_FLOAT, image.bytes);
    return image;
}

} // namespace tidemark::lab
