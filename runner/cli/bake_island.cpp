#include "cli/bake_island.hpp"

#include "cli/console.hpp"
#include "image/picture_file.hpp"
#include "terrain/island.hpp"
#include "terrain/march_study.hpp"
#include "terrain/wave_map.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>

namespace tidemark::cli {
namespace fs = std::filesystem;
namespace {

struct IslandOptions {
    fs::path output = "island.exr";
    image::SampleDepth depth = image::SampleDepth::half;
    int side = 512;
    uint32_t seed = terrain::k_island_seed;
    fs::path heights; ///< of the user; empty: our own island
    double extent = terrain::k_island_extent;
    double sea = 0.0;
    double metres = 1.0;
    bool study = false;
};

Result<terrain::HeightMap> heights_of(const IslandOptions& options) {
    if (options.heights.empty())
        return terrain::make_island(options.side, options.seed);
    return image::read_picture(options.heights).and_then([&](const image::Image& picture) {
        return terrain::heights_from(picture, options.extent, options.sea, options.metres)
            .map_error([&](Error error) {
                error.message = fmt::format("cannot use '{}': {}", options.heights.string(), error.message);
                return error;
            });
    });
}

image::PictureFormat format_of(const IslandOptions& options, const terrain::HeightMap& map) {
    std::vector<std::pair<std::string, std::string>> facts{
        {"Software", "tidemark bake"},
        {"channels", "path distance, wave mask, depth, height"},
        {"extent", fmt::format("{:g}", map.extent)},
        {"radius", fmt::format("{:g}", terrain::circle_radius(map))},
    };
    if (options.heights.empty())
        facts.emplace_back("seed", fmt::format("{}", options.seed));
    else
        facts.emplace_back("heights", options.heights.filename().string());
    return {options.depth, std::move(facts)};
}

Result<int> bake(const IslandOptions& options) {
    if (auto known = image::check_picture_format(options.output, options.depth); !known)
        return fail(std::move(known.error()));
    const std::jthread loading = image::preload_picture_codec(options.output);
    const auto map = heights_of(options);
    if (!map)
        return fail(map.error());
    const auto baked = terrain::bake_wave_map(*map);
    if (!baked) {
        const std::string name =
            options.heights.empty() ? fmt::format("island {}", options.seed) : options.heights.string();
        return fail(baked.error().code, fmt::format("cannot use '{}': {}", name, baked.error().message));
    }
    if (auto written = image::write_picture(options.output, *baked, format_of(options, *map)); !written)
        return fail(std::move(written.error()));
    say(fmt::format("wrote {}", options.output.string()));
    return 0;
}

// ---- The study ------------------------------------------------------------------------------------------

constexpr int k_study_sides[] = {64, 128, 256, 512, 1024};

/// "1.2e-03 1.97": an error, and the power of the spacing with which it fell from the size before.
std::string error_cell(double error, std::optional<double> before) {
    const std::string order = before ? fmt::format("{:5.2f}", std::log2(*before / error)) : "    -";
    return fmt::format("{:8.1e} {}", error, order);
}

Result<void> study(const terrain::KnownCase& known, terrain::Stencil stencil) {
    using terrain::Region;
    if (auto printed = put(fmt::format(
            "\n{}, order {}\n{:>5} | {:^29} | {:^29} | {:>8} {:>8} {:>8} {:>8}\n{:>5} | {:^14} {:^14} | "
            "{:^14} {:^14} |\n",
            known.description, int(stencil), "side", "smooth", "rest", "CPU ms", "ns/node", "updates", "heap",
            "", "largest", "rms", "largest", "rms"));
        !printed)
        return printed;
    std::optional<terrain::MarchSample> before;
    for (const int side : k_study_sides) {
        const terrain::MarchSample sample = terrain::study_march(known, side, stencil);
        const auto cell = [&](Region region, double terrain::ErrorNorms::*norm) {
            const auto of = [&](const terrain::MarchSample& s) { return s.errors[size_t(region)].*norm; };
            return error_cell(of(sample), before ? std::optional(of(*before)) : std::nullopt);
        };
        const double nodes = double(side) * side;
        auto printed = put(fmt::format("{:5} | {} {} | {} {} | {:8.1f} {:8.0f} {:8.2f} {:8.2f}\n", side,
                                       cell(Region::smooth, &terrain::ErrorNorms::largest),
                                       cell(Region::smooth, &terrain::ErrorNorms::rms),
                                       cell(Region::rest, &terrain::ErrorNorms::largest),
                                       cell(Region::rest, &terrain::ErrorNorms::rms), 1e3 * sample.seconds,
                                       1e9 * sample.seconds / nodes, double(sample.work.updates) / nodes,
                                       double(sample.work.heap_operations) / nodes));
        if (!printed)
            return printed;
        before = sample;
    }
    return {};
}

Result<int> study_all() {
    if (auto printed =
            put("Shortest ways from a circle of radius 1 against the exact ones: error, and the power "
                "of the spacing it falls with.\n"
                "smooth: the way keeps 0.1 from land and from the middle. rest of open water: the "
                "middle; of the others: behind\nland and beside it. updates, heap: local solutions "
                "and heap operations a node.\n");
        !printed)
        return fail(std::move(printed.error()));
    for (const terrain::KnownCase& known : terrain::known_cases())
        for (const auto stencil : {terrain::Stencil::first_order, terrain::Stencil::second_order})
            if (auto printed = study(known, stencil); !printed)
                return fail(std::move(printed.error()));
    return 0;
}

} // namespace

void add_bake_island(CLI::App& bake_command, Action& chosen) {
    auto options = std::make_shared<IslandOptions>();
    CLI::App* island = bake_command.add_subcommand(
        "island", "Waves' ways over water, sheltered places, depth and height of an island's sea");
    island->add_option("-o,--output", options->output, "File, .exr or (with --depth float) .tif")
        ->type_name("FILE")
        ->capture_default_str();
    const std::map<std::string, image::SampleDepth> depths{{"half", image::SampleDepth::half},
                                                           {"float", image::SampleDepth::f32}};
    island->add_option("--depth", options->depth, "Bits of a sample: half or float")
        ->transform(CLI::CheckedTransformer(depths))
        ->type_name("half|float")
        ->default_str("half");
    CLI::Option* side = island->add_option("--size", options->side, "Texels a side of the generated island")
                            ->check(CLI::Range(terrain::k_least_side, terrain::k_largest_side))
                            ->type_name("N")
                            ->capture_default_str();
    CLI::Option* seed =
        island->add_option("--seed", options->seed, "Another island of the same kind")->capture_default_str();
    CLI::Option* heights =
        island
            ->add_option("--heights", options->heights, "Your own square height map instead (first channel)")
            ->type_name("FILE")
            ->excludes(side)
            ->excludes(seed);
    island->add_option("--extent", options->extent, "Metres along a side of that map")
        ->needs(heights)
        ->check(CLI::Range(1.0, terrain::k_largest_metres))
        ->type_name("M")
        ->capture_default_str();
    island->add_option("--sea", options->sea, "Its value at the sea's level")
        ->needs(heights)
        ->check(CLI::Range(-1e6, 1e6))
        ->type_name("V")
        ->capture_default_str();
    island->add_option("--metres", options->metres, "Metres of height a value of 1")
        ->needs(heights)
        ->check(CLI::Range(1e-6, 1e6))
        ->type_name("M")
        ->capture_default_str();
    island->add_flag("--study", options->study, "Print error against run time on maps with known answers");
    island->callback(
        [options, &chosen] { chosen = [options] { return options->study ? study_all() : bake(*options); }; });
}

} // namespace tidemark::cli
