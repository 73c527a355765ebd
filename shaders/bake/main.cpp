// Makes the textures of our scenes: the fields of a terrain for waves that roll in to the shore, whose
// accuracy it can study, and the ramps of colours.

#include "bake/ramps.hpp"
#include "bake/study_report.hpp"
#include "bake/wave_map.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/supervision.hpp"
#include "host/command_line.hpp"
#include "host/console.hpp"
#include "host/diagnostics.hpp"
#include "host/supervision.hpp"
#include "media/picture_file.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <csignal>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace tidemark::bake {

using namespace host;
namespace {

namespace fs = std::filesystem;

struct IslandOptions {
    fs::path ramps;  ///< folder to write the ramps to, instead of an island
    fs::path output; ///< empty: island.exr; with --study, no folder
    image::SampleDepth depth = image::SampleDepth::half;
    int side = 512;
    uint32_t seed = bake::k_island_seed;
    fs::path heights; ///< the user's height map; empty: generated island
    double extent = bake::k_island_extent;
    double sea = 0.0;
    double metres = 1.0;
    bool study = false;
    MarchStudyRequest march_study;
};

Result<bake::HeightMap> heights_of(const IslandOptions& options) {
    if (options.heights.empty())
        return bake::make_island(options.side, options.seed);
    return image::read_picture(options.heights).and_then([&](const image::Image& picture) {
        return bake::heights_from(picture, options.extent, options.sea, options.metres)
            .map_error([&](Error error) {
                error.message = fmt::format("cannot use '{}': {}", options.heights.string(), error.message);
                return error;
            });
    });
}

image::PictureFormat format_of(const IslandOptions& options, const bake::HeightMap& map) {
    std::vector<std::pair<std::string, std::string>> facts{
        {"Software", "tidemark bake"},
        {"channels", "path distance, wave mask, depth, height"},
        {"extent", fmt::format("{:g}", map.extent)},
        {"radius", fmt::format("{:g}", bake::circle_radius(map))},
    };
    if (options.heights.empty())
        facts.emplace_back("seed", fmt::format("{}", options.seed));
    else
        facts.emplace_back("heights", options.heights.filename().string());
    return {options.depth, std::move(facts)};
}

Result<int> bake(const IslandOptions& options) {
    OutputPath output = OutputPath::typed_or(options.output, "island.exr");
    if (!options.heights.empty())
        output = output.sparing({options.heights});
    TRY(image::check_picture_format(output.path(), options.depth));
    const std::jthread loading = image::preload_picture_codec(output.path());
    TRY(output.place());
    const auto map = TRY(heights_of(options));
    const auto baked = bake::bake_wave_map(map);
    if (!baked) {
        const std::string name =
            options.heights.empty() ? fmt::format("island {}", options.seed) : options.heights.string();
        return fail(baked.error().code, fmt::format("cannot use '{}': {}", name, baked.error().message));
    }
    TRY(image::write_picture(output, *baked, format_of(options, map)));
    say(fmt::format("wrote {}", output.string()));
    return 0;
}

Result<int> write_ramps(const OutputPath& folder) {
    for (const bake::NamedImage& ramp : bake::make_ramps()) {
        const OutputPath output = folder / (ramp.name + ".png");
        const auto depth =
            ramp.image.type == image::SampleType::f32 ? image::SampleDepth::u16 : image::SampleDepth::u8;
        TRY(image::write_picture(output, ramp.image,
                                 image::PictureFormat{depth, {{"Software", "tidemark bake"}}}));
        say(fmt::format("wrote {}", output.string()));
    }
    return 0;
}

/// Adds the options to `island`; parsing it writes into `options`, which must live as long.
void add_options(Command island, IslandOptions& options) {
    island
        .add_option("-o,--output", options.output,
                    "File, .exr or (with --depth float) .tif [island.exr]; of --study the report's folder")
        .type_name("FILE");
    island
        .add_option(
            "--depth",
            [&options](const std::string& depth) {
                options.depth = depth == "half" ? image::SampleDepth::half : image::SampleDepth::f32;
            },
            "Bits of a sample [half]")
        .check(one_of({"half", "float"}))
        .type_name("half|float");
    const Option side = island.add_option("--size", options.side, "Texels a side of the generated island")
                            .check(number<int>(fmt::format("a whole number from {} to {}", bake::k_least_side,
                                                           bake::k_largest_side),
                                               bake::k_least_side, bake::k_largest_side))
                            .type_name("N")
                            .capture_default_str();
    const Option seed =
        island.add_option("--seed", options.seed, "Another island of the same kind").capture_default_str();
    const Option heights =
        island.add_option("--heights", options.heights, "Your own square height map instead (first channel)")
            .type_name("FILE")
            .excludes(side)
            .excludes(seed);
    island.add_option("--extent", options.extent, "Metres along a side of that map")
        .needs(heights)
        .check(
            number(fmt::format("metres from 1 to {:g}", bake::k_largest_metres), 1.0, bake::k_largest_metres))
        .type_name("M")
        .capture_default_str();
    island.add_option("--sea", options.sea, "Its value at the sea's level")
        .needs(heights)
        .check(number("a number from -1e6 to 1e6", -1e6, 1e6))
        .type_name("V")
        .capture_default_str();
    island.add_option("--metres", options.metres, "Metres of height a value of 1")
        .needs(heights)
        .check(number("metres from 1e-6 to 1e6", 1e-6, 1e6))
        .type_name("M")
        .capture_default_str();
    const Option study = island.add_flag(
        "--study", options.study,
        "Print error against run time on maps with known answers; with -o FOLDER a report of it, too");
    island.add_option("--budget", options.march_study.budget, "Seconds for the timing of that report")
        .needs(study)
        .check(number("seconds from 0.01 to 1e6", 0.01, 1e6))
        .type_name("S")
        .capture_default_str();
    island
        .add_option("--ramps", options.ramps,
                    "Write the ramps of pseudo3d_water and stylized_waves into that folder instead")
        .type_name("FOLDER");
}

Result<int> run(int argc, const char* const* argv) {
    std::signal(SIGPIPE, SIG_IGN); // a reader that closed the pipe is a write error like any other
    clear_leftovers_on_signals();
    CLI::App app("Makes the textures of our scenes: paths of waves, sheltered places, depth and height of an "
                 "island's sea");
    app.name("tidemark_bake");
    format_help(app);
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    IslandOptions options;
    add_options(Command(app), options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& asked) { // --help
        std::ostringstream text;
        app.exit(asked, text, text);
        TRY(put(text.str()));
        return 0;
    } catch (const CLI::Error& error) {
        return fail(ErrorCode::usage, error.what());
    }
    if (!options.ramps.empty())
        return write_ramps(OutputPath::typed(options.ramps));
    options.march_study.folder = options.output;
    return options.study ? study_march(options.march_study) : bake(options);
}

} // namespace
} // namespace tidemark::bake

int main(int argc, char** argv) {
    using namespace tidemark;
    host::end_by_last_resort();
    try {
        const auto outcome = bake::run(argc, argv);
        if (outcome)
            return *outcome;
        host::say(outcome.error());
        return exit_code(outcome.error().code);
    } catch (...) {
        return host::last_resort();
    }
}
