#include "cli/omissions.hpp"

#include "glsl/assemble.hpp"
#include "glsl/specialise/specialise.hpp"
#include "scene/host_uniforms.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace tidemark::cli {
namespace {

/// Returns the host uniforms of a pass that makes a picture.
std::vector<std::string_view> host_uniforms() {
    std::vector<std::string_view> names;
    for (const scene::SiteUniform& uniform : scene::k_site_uniforms)
        if (uniform.image)
            names.push_back(uniform.name);
    names.push_back(scene::k_camera_uniform);
    names.push_back(scene::k_time_low_uniform);
    return names;
}

void add_list(std::vector<std::string>& left_out, std::string_view what,
              const std::vector<std::string>& names) {
    if (!names.empty())
        left_out.push_back(fmt::format("{}: {}", what, fmt::join(names, ", ")));
}

/// Collects the facts of all drawn passes.
class Collector {
public:
    explicit Collector(const render::Renderer& renderer) : renderer_(renderer), scene_(renderer.scene()) {}

    SceneFacts collect() {
        for (const render::PlannedPass& planned : renderer_.plan().passes) {
            for (const gl::Uniform& uniform : renderer_.program(planned.pass).reflection().uniforms)
                if (!has(uniform.name))
                    facts_.uniforms.push_back(uniform.name);
            facts_.passes.push_back({planned.pass, planned.channels});
        }
        add_list(facts_.left_out, "passes", passes_not_drawn());
        add_list(facts_.left_out, "uniforms", unused(host_uniforms()));
        std::vector<std::string> knobs;
        for (const scene::Knob& knob : scene_.knobs)
            knobs.push_back(knob.name);
        add_list(facts_.left_out, "knobs", unused(knobs));
        add_list(facts_.left_out, "channels", channels_not_read());
        add_list(facts_.left_out, "second textures", single_buffers());
        if (!reads_noise())
            facts_.left_out.emplace_back("noise texture");
        return std::move(facts_);
    }

private:
    bool has(std::string_view uniform) const {
        return std::find(facts_.uniforms.begin(), facts_.uniforms.end(), uniform) != facts_.uniforms.end();
    }

    template <class Names>
    std::vector<std::string> unused(const Names& names) const {
        std::vector<std::string> left;
        for (const auto& name : names)
            if (!has(name))
                left.emplace_back(name);
        return left;
    }

    std::vector<std::string> passes_not_drawn() const {
        std::vector<std::string> names;
        for (size_t i = 0; i < scene_.passes.size(); ++i)
            if (!renderer_.plan().find(i))
                names.push_back(scene_.passes[i].name);
        return names;
    }

    /// With several passes, only channels that the scene assigned count as left out.
    std::vector<std::string> channels_not_read() const {
        std::vector<std::string> names;
        const bool several = scene_.passes.size() > 1;
        for (const PassFacts& pass : facts_.passes)
            for (int i = 0; i < scene::k_channel_count; ++i) {
                const scene::Channel& channel = scene_.passes[pass.pass].channels[size_t(i)];
                const bool read =
                    std::find(pass.channels.begin(), pass.channels.end(), i) != pass.channels.end();
                const bool named = !channel.where.file.empty();
                if (read || (several && !traits_of(channel.input).loaded) ||
                    (i >= scene::k_site_channel_count && !named))
                    continue;
                names.push_back(several ? fmt::format("iChannel{} of {}", i, scene_.passes[pass.pass].name)
                                        : fmt::format("iChannel{}", i));
            }
        return names;
    }

    std::vector<std::string> single_buffers() const {
        std::vector<std::string> names;
        for (const PassFacts& pass : facts_.passes)
            if (scene_.passes[pass.pass].kind != scene::PassKind::image &&
                !renderer_.plan().targets[pass.pass].two_textures)
                names.push_back(scene_.passes[pass.pass].name);
        return names;
    }

    /// True if a drawn pass reads the noise texture, the input of channels that were not assigned.
    bool reads_noise() const {
        for (const PassFacts& pass : facts_.passes)
            for (const int i : pass.channels)
                if (const auto& traits = traits_of(scene_.passes[pass.pass].channels[size_t(i)].input);
                    traits.default_input && traits.loaded)
                    return true;
        return false;
    }

    const render::Renderer& renderer_;
    const scene::Scene& scene_;
    SceneFacts facts_;
};

} // namespace

SceneFacts facts_of(const render::Renderer& renderer) {
    return Collector(renderer).collect();
}

glsl::LeftOut left_out_of(const render::Renderer& renderer, size_t pass, glsl::Specialise how) {
    const scene::Scene& scene = renderer.scene();
    if (renderer.precision() != glsl::Precision::single)
        return renderer.left_out(pass);
    return glsl::specialise(glsl::assemble(scene, scene.passes[pass], renderer.dialect(pass)), scene.knobs,
                            how)
        .left_out;
}

} // namespace tidemark::cli
