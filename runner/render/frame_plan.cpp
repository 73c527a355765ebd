#include "render/frame_plan.hpp"

#include "render/gl_context.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <span>

namespace tidemark::render {
namespace {

/// Returns whether the array of that name has an element `number` that the program uses.
bool has_element(const gl::Reflection& reflection, std::string_view name, int number) {
    const gl::Uniform* uniform = reflection.find(name);
    return uniform && number < uniform->length;
}

/// Returns whether the type is a sampler that a text can declare.
bool is_sampler(GLenum type) {
    constexpr GLenum k_samplers[] = {GL_SAMPLER_2D,
                                     GL_SAMPLER_3D,
                                     GL_SAMPLER_CUBE,
                                     GL_SAMPLER_2D_ARRAY,
                                     GL_SAMPLER_2D_SHADOW,
                                     GL_SAMPLER_CUBE_SHADOW,
                                     GL_INT_SAMPLER_2D,
                                     GL_INT_SAMPLER_3D,
                                     GL_INT_SAMPLER_CUBE,
                                     GL_UNSIGNED_INT_SAMPLER_2D,
                                     GL_UNSIGNED_INT_SAMPLER_3D,
                                     GL_UNSIGNED_INT_SAMPLER_CUBE};
    return std::ranges::find(k_samplers, type) != std::end(k_samplers);
}

/// Returns whether the program has a sampler of the author's. It stays at unit 0, that of iChannel0.
bool has_own_sampler(const gl::Reflection& reflection) {
    return std::ranges::any_of(reflection.uniforms, [](const gl::Uniform& uniform) {
        const bool is_host = uniform.name == "iKeyboard" || uniform.name.starts_with("iChannel") ||
                             (uniform.name.starts_with("iCh") && uniform.name.ends_with(".sampler"));
        return is_sampler(uniform.type) && !is_host;
    });
}

bool samples(const gl::Reflection& reflection, int number) {
    return reflection.has(fmt::format("iChannel{}", number)) ||
           reflection.has(fmt::format("iCh{}.sampler", number)) ||
           (number == 0 && has_own_sampler(reflection));
}

/// Returns whether the program reads the channel's size, its time or whether it is loaded.
bool asks_about(const gl::Reflection& reflection, int number) {
    const auto begins = [&](const std::string& prefix) {
        return std::ranges::any_of(reflection.uniforms, [&](const gl::Uniform& uniform) {
            return uniform.name.starts_with(prefix);
        });
    };
    return has_element(reflection, "iChannelResolution", number) ||
           has_element(reflection, "iChannelTime", number) || begins(fmt::format("iCh{}.", number)) ||
           begins(fmt::format("iChannel[{}].", number));
}

class Planner {
public:
    Planner(const scene::Scene& scene, const std::vector<std::optional<gl::Reflection>>& reflections,
            const Extras& extras, const std::vector<size_t>& discarding)
        : scene_(scene), reflections_(reflections), extras_(extras), discarding_(discarding),
          needed_(scene.passes.size(), false) {
        plan_.targets.resize(scene.passes.size());
    }

    FramePlan plan(size_t shown) {
        need(shown);
        for (size_t pass = 0; extras_.passes && pass < needed_.size(); ++pass)
            need(pass);
        for (size_t pass = 0; pass < needed_.size(); ++pass)
            if (needed_[pass])
                plan_.passes.push_back({pass, channels_of(pass), reflections_[pass]->has("iKeyboard")});
        for (const PlannedPass& planned : plan_.passes)
            for (const int channel : planned.channels)
                plan_read(planned.pass, scene_.passes[planned.pass].channels[size_t(channel)]);
        for (const size_t pass : discarding_)
            if (needed_[pass])
                plan_discarding(pass);
        for (const PlannedPass& planned : plan_.passes)
            if (scene_.passes[planned.pass].kind != scene::PassKind::image)
                add_extras(plan_.targets[planned.pass]);
        return std::move(plan_);
    }

private:
    std::vector<int> channels_of(size_t pass) const {
        std::vector<int> channels;
        for (int number = 0; number < scene::k_channel_count; ++number)
            if ((extras_.channels && number < scene::k_site_channel_count) ||
                needs_texture(scene_.passes[pass].channels[size_t(number)].input, number,
                              *reflections_[pass]))
                channels.push_back(number);
        return channels;
    }

    void need(size_t pass) {
        if (needed_[pass] || !reflections_[pass])
            return;
        needed_[pass] = true;
        for (const int channel : channels_of(pass))
            if (const size_t* source = source_pass(scene_.passes[pass].channels[size_t(channel)].input))
                need(*source);
    }

    void plan_read(size_t reader, const scene::Channel& channel) {
        const size_t* source = source_pass(channel.input);
        if (!source)
            return;
        TargetPlan& target = plan_.targets[*source];
        target.mipmaps = target.mipmaps || channel.sampling.mipmaps != scene::Mipmaps::none;
        // An earlier pass reads last frame's texture before it is overwritten. Only a pass that reads itself
        // needs a second texture.
        target.two_textures = target.two_textures || reader == *source;
        if (frame_ref(reader, *source) == FrameRef::previous) {
            plan_.feedback = true;
            target.carried = std::max(target.carried, 1);
        }
    }

    void plan_discarding(size_t pass) {
        plan_.feedback = true;
        TargetPlan& target = plan_.targets[pass];
        target.two_textures = target.two_textures || scene_.passes[pass].kind != scene::PassKind::image;
        target.carried = target.two_textures ? 2 : 1;
    }

    void add_extras(TargetPlan& target) const {
        target.mipmaps = target.mipmaps || extras_.mipmaps;
        target.two_textures = target.two_textures || extras_.second_textures;
    }

    const scene::Scene& scene_;
    const std::vector<std::optional<gl::Reflection>>& reflections_;
    const Extras extras_;
    const std::vector<size_t>& discarding_;
    std::vector<bool> needed_;
    FramePlan plan_;
};

} // namespace

bool needs_texture(const scene::ChannelInput& input, int number, const gl::Reflection& reflection) {
    const bool facts_from_texture = traits_of(input).loaded && !source_pass(input);
    return samples(reflection, number) || (facts_from_texture && asks_about(reflection, number));
}

const PlannedPass* FramePlan::find(size_t pass) const {
    const auto found = std::find_if(passes.begin(), passes.end(),
                                    [&](const PlannedPass& planned) { return planned.pass == pass; });
    return found == passes.end() ? nullptr : &*found;
}

FrameRef frame_ref(size_t reader, size_t source) {
    return source < reader ? FrameRef::current : FrameRef::previous;
}

bool may_have_feedback(const scene::Scene& scene) {
    for (size_t reader = 0; reader < scene.passes.size(); ++reader)
        for (const scene::Channel& channel : scene.passes[reader].channels)
            if (const size_t* const source = scene::source_pass(channel.input);
                source && frame_ref(reader, *source) == FrameRef::previous)
                return true;
    return false;
}

FramePlan plan_frame(const scene::Scene& scene, const std::vector<std::optional<gl::Reflection>>& reflections,
                     size_t shown, const Extras& extras, const std::vector<size_t>& discarding) {
    return Planner(scene, reflections, extras, discarding).plan(shown);
}

Result<void> check_size(Extent extent) {
    const int limit = gl::query_capabilities().largest_target;
    if (std::max(extent.width, extent.height) <= limit)
        return {};
    return fail(ErrorCode::usage, fmt::format("--size {}x{}: this driver draws at most {} pixels on a side",
                                              extent.width, extent.height, limit));
}

Result<PassTarget> PassTarget::create(Extent extent, GLenum internal_format, const TargetPlan& plan) {
    TRY(check_size(extent));
    PassTarget target;
    target.plan_ = plan;
    for (int i = 0; i < (plan.two_textures ? 2 : 1); ++i) {
        auto surface =
            gl::make_render_target(gl::make_texture(extent, internal_format, plan.mipmaps ? 0 : 1));
        if (!surface)
            return fail(
                ErrorCode::no_memory,
                fmt::format(
                    "--size {}x{}: this driver has no memory for a picture of that size; give a smaller one",
                    extent.width, extent.height));
        target.surfaces_.push_back(*std::move(surface));
    }
    return target;
}

Result<PassTarget> PassTarget::create_cube(const TargetPlan& plan) {
    PassTarget target;
    target.plan_ = plan;
    for (int i = 0; i < (plan.two_textures ? 2 : 1); ++i) {
        auto surface =
            gl::make_render_target(gl::make_cube_texture(k_cube_side, GL_RGBA16F, plan.mipmaps ? 0 : 1));
        if (!surface)
            return fail(ErrorCode::no_memory, "this driver has no memory for a cubemap pass");
        target.surfaces_.push_back(*std::move(surface));
    }
    return target;
}

void PassTarget::flip() {
    spare_.reset();
    latest_ = next_index();
    ++edition_;
    gl::make_mipmaps(latest().texture);
}

std::optional<gl::RenderTarget> PassTarget::make_apart(bool keeps) {
    const gl::Texture& like = next().texture;
    const bool cube = like.target == GL_TEXTURE_CUBE_MAP;
    auto apart = std::exchange(spare_, std::nullopt);
    if (!apart)
        apart = gl::make_render_target(
            cube ? gl::make_cube_texture(like.extent.width, like.internal_format, like.levels)
                 : gl::make_texture(like.extent, like.internal_format, like.levels));
    if (apart && keeps)
        gl::copy_overlap(next(), *apart);
    return apart;
}

void PassTarget::take_over(gl::RenderTarget& apart) {
    std::swap(surfaces_[next_index()], apart);
    latest_ = next_index();
    ++edition_;
}

void PassTarget::take_back(gl::RenderTarget& apart) {
    latest_ = next_index();
    std::swap(surfaces_[next_index()], apart);
    --edition_;
}

void PassTarget::clear() {
    for (const gl::RenderTarget& surface : surfaces_)
        gl::clear(surface);
    ++edition_;
}

std::vector<TextureFloats> PassTarget::carried() const {
    std::vector<TextureFloats> textures;
    for (int i = 0; i < plan_.carried; ++i)
        textures.push_back(gl::read_level((i == 0 ? latest() : next()).texture, 0));
    return textures;
}

bool PassTarget::can_restore(const std::vector<TextureFloats>& carried) const {
    const gl::Texture& texture = latest().texture;
    const size_t floats = texture.extent.pixels() * size_t(texture.depth) * 4;
    return carried.size() == size_t(plan_.carried) &&
           std::ranges::all_of(carried, [&](const TextureFloats& t) { return t.size() == floats; });
}

void PassTarget::restore(const std::vector<TextureFloats>& carried) {
    for (size_t i = 0; i < carried.size(); ++i) {
        const gl::Texture& texture = (i == 0 ? latest() : next()).texture;
        const auto bytes = std::as_bytes(std::span(carried[i]));
        const size_t layer = bytes.size() / size_t(texture.depth);
        for (int face = 0; face < texture.depth; ++face)
            gl::upload(texture, face, GL_RGBA, GL_FLOAT, bytes.subspan(size_t(face) * layer, layer));
        gl::make_mipmaps(texture);
    }
    ++edition_;
}

void PassTarget::continue_from(const PassTarget& other) {
    gl::copy_overlap(other.latest(), latest());
    gl::make_mipmaps(latest().texture);
    edition_ = other.edition_ + 1;
}

size_t PassTarget::bytes() const {
    size_t bytes = 0;
    for (const gl::RenderTarget& surface : surfaces_)
        bytes += gl::bytes_of(surface.texture);
    return bytes + (spare_ ? gl::bytes_of(spare_->texture) : 0);
}

Result<PassTarget> PassTarget::resized(Extent extent) const {
    auto fresh = create(extent, internal_format(), plan_);
    if (fresh)
        fresh->continue_from(*this);
    return fresh;
}

} // namespace tidemark::render
