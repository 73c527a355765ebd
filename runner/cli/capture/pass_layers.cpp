#include "cli/capture/pass_layers.hpp"

#include "cli/output_name.hpp"

#include <fmt/format.h>

namespace tidemark::cli {
namespace {

/// One picture of a pass that is not shown.
struct Source {
    std::string name;
    size_t pass;
    int face = 0;
    bool cube = false;
};

std::vector<Source> sources(const render::Renderer& renderer) {
    std::vector<Source> all;
    for (const render::PlannedPass& planned : renderer.plan().passes) {
        const scene::Pass& pass = renderer.scene().passes[planned.pass];
        if (planned.pass == renderer.shown_index())
            continue;
        if (pass.kind != scene::PassKind::cubemap) {
            all.push_back({pass.name, planned.pass});
            continue;
        }
        for (int face = 0; face < int(k_face_names.size()); ++face)
            all.push_back(
                {fmt::format("{} {}", pass.name, k_face_names[size_t(face)]), planned.pass, face, true});
    }
    return all;
}

} // namespace

std::vector<image::PictureLayer> other_layers(const render::Renderer& renderer, image::SampleDepth depth) {
    const image::PictureFormat format{
        .depth = depth, .transfer = image::Transfer::data, .alpha = image::Alpha::straight};
    std::vector<image::PictureLayer> layers;
    for (const Source& source : sources(renderer)) {
        const image::Image drawn = renderer.read_floats(source.pass, source.face);
        // The first row of a face is its top row (image::CubeFaces).
        layers.push_back({source.name, source.cube ? image::flipped(drawn) : drawn, format});
    }
    return layers;
}

std::vector<std::string> layer_names(const render::Renderer& renderer) {
    std::vector<std::string> names{renderer.shown_pass().name};
    for (const Source& source : sources(renderer))
        names.push_back(source.name);
    return names;
}

} // namespace tidemark::cli
