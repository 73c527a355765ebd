#include "render/compiled_scene.hpp"

#include "base/try.hpp"
#include "glsl/pass_reading.hpp"
#include "render/channel_textures.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace tidemark::render {
namespace {

using image::SampleType;
using scene::PassKind;

/// Supplies a cube or a volume to channels that the text samples as such and the scene leaves unspecified.
void supply_other_kinds(scene::Scene& scene, size_t pass, const glsl::ChannelKinds& kinds) {
    for (size_t i = 0; i < kinds.size(); ++i) {
        scene::Channel& channel = scene.passes[pass].channels[i];
        if (kinds[i] == texture_kind(scene, channel.input))
            continue;
        if (kinds[i] == scene::TextureKind::cube)
            channel = {
                scene::StandIn{scene::StandIn::Kind::cubemap, 256, 256, 4}, scene::k_cubemap_sampling, {}};
        else
            channel.input = scene::Noise{scene::NoiseKind::rgba_volume_32};
    }
}

bool reads(const scene::Pass& reader, size_t pass) {
    return std::ranges::any_of(reader.channels, [&](const scene::Channel& channel) {
        const size_t* source = source_pass(channel.input);
        return source && *source == pass;
    });
}

} // namespace

Result<CompiledScene> CompiledScene::create(scene::Scene scene, const RenderOptions& options) {
    CompiledScene compiled(std::move(scene), options);
    for (const auto step : {&CompiledScene::choose_pass, &CompiledScene::compile})
        TRY((compiled.*step)());
    return compiled;
}

Result<void> CompiledScene::choose_pass() {
    const std::string& name = options_.pass;
    shown_ = scene_.image_index();
    if (name.empty())
        return {};
    std::vector<std::string> names;
    for (size_t i = 0; i < scene_.passes.size(); ++i) {
        if (scene_.passes[i].kind == PassKind::sound)
            continue;
        if (scene_.passes[i].name == name) {
            shown_ = i;
            return {};
        }
        names.push_back(scene_.passes[i].name);
    }
    return fail(ErrorCode::usage, fmt::format("--pass {}: the scene has {}", name, fmt::join(names, ", ")));
}

/// Finds the passes that the shown one may need according to the scene; only these are compiled.
std::vector<bool> CompiledScene::reachable() const {
    std::vector<bool> found(scene_.passes.size(), false);
    std::vector<size_t> open{shown_};
    for (size_t pass = 0; options_.extras.passes && pass < scene_.passes.size(); ++pass)
        if (scene_.passes[pass].kind != PassKind::sound)
            open.push_back(pass);
    while (!open.empty()) {
        const size_t pass = open.back();
        open.pop_back();
        if (found[pass])
            continue;
        found[pass] = true;
        for (const scene::Channel& channel : scene_.passes[pass].channels)
            if (const size_t* source = source_pass(channel.input))
                open.push_back(*source);
    }
    return found;
}

/// A pass can be tiled if it is the last of a frame, no pass reads it, and it keeps nothing for the next
/// frame.
bool CompiledScene::can_be_tiled() const {
    const std::vector<bool> drawn = reachable();
    for (size_t i = 0; i < drawn.size(); ++i) {
        if (drawn[i] && (i > shown_ || reads(scene_.passes[i], shown_)))
            return false;
    }
    return scene_.passes[shown_].kind != PassKind::cubemap &&
           !glsl::PassReading(scene_, scene_.passes[shown_]).discards();
}

Result<void> CompiledScene::compile() {
    if (options_.tile && !can_be_tiled())
        options_.tile.reset();
    passes_.resize(scene_.passes.size());
    std::vector<std::optional<gl::Reflection>> reflections(scene_.passes.size());
    std::vector<size_t> discarding;
    const std::vector<bool> wanted = reachable();
    const bool marks =
        options_.marks_non_finite && format_of(shown_) == GL_RGBA8 &&
        std::ranges::none_of(scene_.passes, [&](const auto& pass) { return reads(pass, shown_); });
    for (size_t i = 0; i < scene_.passes.size(); ++i) {
        if (!wanted[i])
            continue;
        auto linked = TRY(link_pass(scene_, scene_.passes[i],
                                    {options_.precision, options_.specialise, options_.tile && i == shown_,
                                     marks && i == shown_, options_.keeps_alpha}));
        supply_other_kinds(scene_, i, linked.dialect.channels);
        reflections[i] = linked.program.reflection();
        if (linked.discards)
            discarding.push_back(i);
        UniformTable uniforms(linked.program.reflection(), names_of(i, linked.dialect),
                              options_.extras.uniforms);
        passes_[i] = CompiledPass{std::move(linked), std::move(uniforms)};
    }
    plan_ = plan_frame(scene_, reflections, shown_, options_.extras, discarding);
    return {};
}

/// Accepts the uniform names of other hosts for a file outside of a project or with its own `main`.
UniformTable::Names CompiledScene::names_of(size_t pass, const glsl::Dialect& dialect) const {
    return {scene_.knobs, scene_.passes[pass].bare_file || dialect.main == glsl::MainPlace::author};
}

GLenum CompiledScene::format_of(size_t pass) const {
    return scene_.passes[pass].kind == PassKind::image && options_.samples == SampleType::u8 ? GL_RGBA8
                                                                                             : GL_RGBA32F;
}

} // namespace tidemark::render
