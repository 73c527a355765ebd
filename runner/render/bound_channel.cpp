#include "render/bound_channel.hpp"

#include "base/try.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace tidemark::render {
namespace {

std::vector<std::string> sampler_names(int unit) {
    if (unit == k_keyboard_unit)
        return {"iKeyboard"};
    return {fmt::format("iChannel{}", unit), fmt::format("iCh{}.sampler", unit)};
}

} // namespace

Result<BoundChannel> make_channel(const gl::Program& program, int unit, const scene::Channel& channel,
                                  ChannelTextures& textures) {
    BoundChannel bound{unit, make_sampler(channel.sampling), {}};
    if (const size_t* pass = source_pass(channel.input)) {
        bound.source = scene::PassOutput{*pass};
    } else {
        bound.source = TRY(textures.require(channel));
    }
    point_samplers(program, unit);
    return bound;
}

void point_samplers(const gl::Program& program, int unit) {
    const double number[] = {double(unit)};
    for (const std::string& name : sampler_names(unit))
        if (const gl::Uniform* sampler = program.reflection().find(name))
            gl::set_uniform(program, *sampler, number);
}

void bind(const BoundChannel& channel, const gl::Texture& texture) {
    if (texture.target == GL_TEXTURE_CUBE_MAP)
        glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS); // as WebGL 2 always does
    glBindTextureUnit(GLuint(channel.unit), texture.id());
    glBindSampler(GLuint(channel.unit), channel.sampler.id());
}

} // namespace tidemark::render
