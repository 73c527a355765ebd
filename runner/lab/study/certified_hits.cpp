#include "base/hash.hpp"
#include "base/try.hpp"
#include "lab/fields/certified_march.hpp"
#include "lab/on_all_cores.hpp"
#include "lab/study/stricter.hpp"
#include "lab/study/truth.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace tidemark::lab {
namespace {

// ---- The lattice ----------------------------------------------------------------------------------------

constexpr int k_lattice_side = 1024;

/// `sine_hash` of every whole number around 0, as this device has it. The text is that of
/// shaders/lib/hash.glsl.
Result<SineLattice> read_sine_lattice() {
    scene::Scene scene;
    scene.file = "sine_hash";
    scene.passes.resize(1);
    scene.passes[0].name = "Image";
    scene.passes[0].text.append(fmt::format("void mainImage(out vec4 c, in vec2 p) {{\n"
                                            "    float n = floor(p.x) + {0}.0 * (floor(p.y) - {1}.0);\n"
                                            "    c = fract(sin(vec4(n)) * 43785.5);\n"
                                            "}}\n",
                                            k_lattice_side, k_lattice_side / 2),
                                "sine_hash", 1);
    auto renderer = render::Renderer::create(std::move(scene),
                                             {{k_lattice_side, k_lattice_side}, image::SampleType::f32, ""});
    if (!renderer)
        return fail(std::move(renderer.error()));
    renderer->draw({});
    const image::Image image = renderer->read_back();
    SineLattice lattice{-int64_t{k_lattice_side} * k_lattice_side / 2, {}};
    for (size_t i = 0; i < image.extent.pixels(); ++i)
        lattice.values.push_back(image.f32()[4 * i]);
    return lattice;
}

struct NamedLattice {
    Lattice3 lattice;
    std::string name;
};

Result<NamedLattice> lattice_of(const FoundReference& found) {
    if (!found.sine_lattice)
        return NamedLattice{IntegerLattice{}, "integer lattice, the same on every device"};
    auto lattice = TRY(read_sine_lattice());
    const std::string digest = sha256(std::as_bytes(std::span(lattice.values)));
    return NamedLattice{
        std::move(lattice),
        fmt::format("lattice of sines read back from this device (SHA-256 {}...)", digest.substr(0, 12))};
}

// ---- The march ------------------------------------------------------------------------------------------

glm::dvec2 centre(size_t pixel, Extent extent) {
    return {double(pixel % size_t(extent.width)) + 0.5, double(pixel / size_t(extent.width)) + 0.5};
}

/// The first hit of one pixel in `every`, on all cores; the others stay misses. False: stopped.
bool march(const Reference& reference, Extent extent, const CertifiedOptions& options, size_t every,
           const KeepGoing& keep_going, Hits& hits) {
    const size_t pixels = extent.pixels();
    hits.distance.assign(pixels, -1.0);
    hits.evaluations.assign(pixels, 0.0f);
    hits.flags.assign(pixels, 0);
    return on_all_cores(size_t(extent.height), keep_going, [&](size_t row) {
        const size_t begin = row * size_t(extent.width);
        for (size_t i = begin; i < begin + size_t(extent.width); ++i) {
            if (i % every != 0)
                continue;
            const CertifiedHit hit =
                certified_march(reference.field, reference.ray(centre(i, extent)), reference.range, options);
            hits.distance[i] = std::isfinite(hit.distance) ? hit.distance : std::nan("");
            hits.evaluations[i] = float(hit.samples);
        }
    });
}

std::vector<double> footprints(const Reference& reference, Extent extent) {
    std::vector<double> widths;
    for (size_t i = 0; i < extent.pixels(); ++i) {
        const glm::dvec2 at = centre(i, extent);
        widths.push_back(
            glm::distance(reference.ray(at).direction, reference.ray(at + glm::dvec2(0, 1)).direction));
    }
    return widths;
}

Result<Reference> reference_of(const FoundReference& found, const scene::Scene& scene, const View& view,
                               Extent extent, const Lattice3& lattice) {
    const render::FrameInputs inputs = inputs_of(state_of(view, extent));
    ReferenceInputs wanted;
    wanted.knobs = scene.knobs;
    wanted.time = inputs.time;
    wanted.resolution = {extent.width, extent.height};
    wanted.mouse = {inputs.mouse.x, inputs.mouse.y};
    wanted.octaves = found.octaves;
    wanted.turning_poles = found.turning_poles;
    wanted.drift_wraps = found.drift_wraps;
    wanted.lattice = lattice;
    return found.make(wanted);
}

constexpr CertifiedOptions k_usual{};
/// A second reference with a tenth of the shortest step, on every 37th pixel, which is all columns and rows.
constexpr CertifiedOptions k_stricter{k_usual.shortest_step / 10};
constexpr size_t k_checked = 37;

/// RMS of the change from the usual march to the stricter one, where both ran and answered; a hit that came
/// or went counts with the range.
struct SelfCheck {
    double squares = 0;
    double largest = 0;
    size_t rays = 0;
    size_t came_or_went = 0;

    void add(const Hits& usual, const Hits& stricter) {
        for (size_t i = 0; i < usual.size(); i += k_checked) {
            const double change = std::abs(usual.distance[i] - stricter.distance[i]);
            if (std::isnan(change))
                continue;
            ++rays;
            came_or_went += (usual.distance[i] < 0) != (stricter.distance[i] < 0);
            squares += change * change;
            largest = std::max(largest, change);
        }
    }
};

Standard standard_of(const FoundReference& found, const std::vector<Setting>& settings, double lipschitz,
                     const std::string& lattice, const SelfCheck& check) {
    Standard standard;
    standard.method = fmt::format("certified march in double, written for the text of this field (SHA-256 "
                                  "{}...){}: steps proved by a slope bound of {:.4g} from the knobs, at "
                                  "least {:g}; {}",
                                  found.field_hash.substr(0, 12),
                                  settings.empty() ? "" : fmt::format(" with {}", to_string(settings)),
                                  lipschitz, k_usual.shortest_step, lattice);
    standard.field_hash = found.field_hash;
    standard.uncertainty = std::sqrt(check.squares / double(std::max<size_t>(1, check.rays)));
    standard.check =
        fmt::format("a second march with a tenth of the shortest step on {} rays: RMS {:.2g}, largest "
                    "{:.2g}, {} hits came or went",
                    check.rays, *standard.uncertainty, check.largest, check.came_or_went);
    return standard;
}

} // namespace

Result<CertifiedHits> certified_hits(const scene::Scene& scene, const Study& study,
                                     const KeepGoing& keep_going) {
    const std::vector<Setting> settings = strictest(study, 0);
    const auto set = TRY(with(scene, settings));
    const auto found = find_reference(set);
    if (!found) {
        auto proved = TRY(hits_proved_from_text(set, study, settings, keep_going));
        if (!proved.truth)
            proved.why_not = fmt::format("{}, and {}", found.error().message, proved.why_not);
        return proved;
    }
    const auto lattice = TRY(lattice_of(*found));
    HitTruth truth;
    SelfCheck check;
    for (const View& view : study.views) {
        auto reference = reference_of(*found, set, view, study.extent, lattice.lattice);
        if (!reference)
            return CertifiedHits{{}, reference.error().message};
        Hits hits, stricter;
        if (!march(*reference, study.extent, k_usual, 1, keep_going, hits) ||
            !march(*reference, study.extent, k_stricter, k_checked, keep_going, stricter))
            return CertifiedHits{{}, "interrupted"};
        check.add(hits, stricter);
        truth.views.push_back(std::move(hits));
        truth.footprints.push_back(footprints(*reference, study.extent));
        truth.references.push_back(*std::move(reference));
    }
    size_t rays = 0, blind = 0;
    for (const Hits& hits : truth.views) {
        rays += hits.size();
        blind += size_t(std::ranges::count_if(hits.distance, [](double t) { return std::isnan(t); }));
    }
    if (double(blind) > k_most_blind * double(rays))
        return CertifiedHits{{}, fmt::format("its field is NaN on {} of {} rays", blind, rays)};
    const double lipschitz = truth.references.empty() ? 0 : truth.references.front().field.lipschitz;
    truth.standard = standard_of(*found, settings, lipschitz, lattice.name, check);
    truth.standard.blind = blind;
    return CertifiedHits{std::move(truth), {}};
}

} // namespace tidemark::lab
