#include "render/frame_plan.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::render {
namespace {

/// Returns whether the array of that name has an element `number` that the program uses.
bool has_element(const gl::Reflection& reflection, std::string_view name, int number) {
    const gl::Uniform* uniform = reflection.find(name);
    return uniform && number < uniform->length;
}

bool samples(const gl::Reflection& reflection, int number) {
    return reflection.has(fmt::format("iChannel{}", number)) ||
           reflection.has(fmt::format("iCh{}.sampler", number));
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

} // namespace tidemark::render
