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
    return std::visit(
        [&]<class Kind>(const Kind& kind) {
            if constexpr (k_traits<Kind>.from == ReadsFrom::pass)
                return scene.passes[kind.pass].kind == PassKind::cubemap ? TextureKind::cube
                                                                         : TextureKind::flat;
            else if constexpr (k_traits<Kind>.texture)
                return *k_traits<Kind>.texture;
            else
                return kind.texture();
        },
        input);
}

} // namespace tidemark::scene
