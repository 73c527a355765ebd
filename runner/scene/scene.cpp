#include "scene/scene.hpp"

#include <algorithm>

namespace tidemark::scene {
namespace fs = std::filesystem;

std::string Scene::name() const {
    const fs::path named = file.has_filename() ? file : file.parent_path(); // "folder/" has none
    return named.stem().string();
}

const Pass* Scene::find(PassKind kind) const {
    const auto found =
        std::find_if(passes.rbegin(), passes.rend(), [&](const Pass& pass) { return pass.kind == kind; });
    return found == passes.rend() ? nullptr : &*found;
}

size_t Scene::image_index() const {
    const Pass* const image = find(PassKind::image);
    return size_t((image ? image : find(PassKind::hit)) - passes.data());
}

TextureKind texture_kind(const Scene& scene, const ChannelInput& input) {
    if (const auto* output = std::get_if<PassOutput>(&input))
        return scene.passes[output->pass].kind == PassKind::cubemap ? TextureKind::cube : TextureKind::flat;
    if (const auto* noise = std::get_if<Noise>(&input))
        return noise->kind >= NoiseKind::grey_volume_32 ? TextureKind::volume : TextureKind::flat;
    if (const auto* stand_in = std::get_if<StandIn>(&input))
        return stand_in->kind == StandIn::Kind::cubemap  ? TextureKind::cube
               : stand_in->kind == StandIn::Kind::volume ? TextureKind::volume
                                                         : TextureKind::flat;
    if (const auto* unbound = std::get_if<Unbound>(&input))
        return unbound->kind;
    if (std::holds_alternative<Cubemap>(input))
        return TextureKind::cube;
    return std::holds_alternative<Volume>(input) ? TextureKind::volume : TextureKind::flat;
}

} // namespace tidemark::scene
