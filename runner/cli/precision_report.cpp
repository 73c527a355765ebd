#include "cli/precision_report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tidemark::cli {
namespace {

template <class Use>
void each_hash(const render::Renderer& renderer, Use use) {
    for (const render::PlannedPass& planned : renderer.plan().passes)
        for (const glsl::KeptHash& hash : renderer.kept_hashes(planned.pass))
            use(renderer.scene().passes[planned.pass], hash);
}

} // namespace

std::string name_of(glsl::Precision precision) {
    return precision == glsl::Precision::single ? "single" : "double";
}

void add_precision(nlohmann::ordered_json& report, const render::Renderer& renderer) {
    report["precision"] = name_of(renderer.precision());
    if (renderer.precision() == glsl::Precision::single)
        return;
    auto& hashes = report["float_hashes"] = nlohmann::ordered_json::array();
    each_hash(renderer, [&](const scene::Pass& pass, const glsl::KeptHash& hash) {
        hashes.push_back({{"pass", pass.name},
                          {"function", hash.function},
                          {"file", hash.where.file},
                          {"line", hash.where.line},
                          {"kind", glsl::to_string(hash.kind)}});
    });
}

std::string precision_lines(const render::Renderer& renderer) {
    if (renderer.precision() == glsl::Precision::single)
        return {};
    std::string text = "  precision double\n";
    each_hash(renderer, [&](const scene::Pass&, const glsl::KeptHash& hash) {
        text += fmt::format("  float     {} hash {}, {}:{}\n", glsl::to_string(hash.kind), hash.function,
                            hash.where.file, hash.where.line);
    });
    return text;
}

} // namespace tidemark::cli
