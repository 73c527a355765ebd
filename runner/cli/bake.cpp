// `bake island --study`: error of the fast marching against its run time, on maps with known answers; as a
// table and, with a folder, as a report like that of `tidemark study`.

#include "base/error.hpp"
#include "cli/commands.hpp"
#include "host/command_line.hpp"
#include "host/console.hpp"
#include "host/study_support.hpp"
#include "lab/outcome.hpp"
#include "lab/work_precision.hpp"
#include "media/baked_textures.hpp"
#include "media/fast_marching_study.hpp"
#include "media/generated_textures.hpp"
#include "media/picture_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

namespace tidemark::cli {

struct MarchStudyRequest {
    std::filesystem::path folder; ///< of the report; empty: print only the table
    double budget = 30;           ///< seconds for the timing
};

/// Returns the exit code.
Result<int> study_march(const MarchStudyRequest& request);

// `bake island`: bakes the fields of a terrain for waves that roll in to the shore, and studies their
// accuracy.

void add_bake_island(Command bake, Action& chosen);

namespace {

constexpr int k_study_sides[] = {64, 128, 256, 512, 1024};

// ---- The table

/// Formats an error and its order of convergence against the previous size, for example "1.2e-03 1.97".
std::string error_cell(double error, std::optional<double> before) {
    const std::string order = before ? fmt::format("{:5.2f}", std::log2(*before / error)) : "    -";
    return fmt::format("{:8.1e} {}", error, order);
}

Result<void> put_table(const bake::KnownCase& known, bake::Stencil stencil) {
    using bake::Region;
    if (auto printed = put(fmt::format(
            "\n{}, order {}\n{:>5} | {:^29} | {:^29} | {:>8} {:>8} {:>8} {:>8}\n{:>5} | {:^14} {:^14} | "
            "{:^14} {:^14} |\n",
            known.description, int(stencil), "side", "smooth", "rest", "CPU ms", "ns/node", "updates", "heap",
            "", "largest", "rms", "largest", "rms"));
        !printed)
        return printed;
    std::optional<bake::MarchSample> before;
    for (const int side : k_study_sides) {
        const bake::MarchSample sample = bake::study_march(known, side, stencil);
        const auto cell = [&](Region region, double bake::ErrorNorms::*norm) {
            const auto of = [&](const bake::MarchSample& s) { return s.errors[size_t(region)].*norm; };
            return error_cell(of(sample), before ? std::optional(of(*before)) : std::nullopt);
        };
        const double nodes = double(side) * side;
        auto printed = put(fmt::format(
            "{:5} | {} {} | {} {} | {:8.1f} {:8.0f} {:8.2f} {:8.2f}\n", side,
            cell(Region::smooth, &bake::ErrorNorms::largest), cell(Region::smooth, &bake::ErrorNorms::rms),
            cell(Region::rest, &bake::ErrorNorms::largest), cell(Region::rest, &bake::ErrorNorms::rms),
            1e3 * sample.seconds, 1e9 * sample.seconds / nodes, double(sample.work.updates) / nodes,
            double(sample.work.heap_operations) / nodes));
        if (!printed)
            return printed;
        before = sample;
    }
    return {};
}

Result<void> put_tables() {
    if (auto printed =
            put("Shortest paths from a circle of radius 1 against the exact ones: the error, and its order "
                "in the spacing.\nsmooth: paths that stay 0.1 away from land and from the middle. rest: in "
                "open water the middle, otherwise the water\nin the shadow of land and along it. updates, "
                "heap: local solutions and heap operations per node.\n");
        !printed)
        return printed;
    for (const bake::KnownCase& known : bake::known_cases())
        for (const auto stencil : {bake::Stencil::first_order, bake::Stencil::second_order})
            TRY(put_table(known, stencil));
    return {};
}

// ---- The report

constexpr bake::Stencil k_stencils[] = {bake::Stencil::first_order, bake::Stencil::second_order};
constexpr int k_usual_side = 512; // the default of `bake island`

/// The parameters of the marching at one point of the study.
struct MarchSetting {
    bake::Stencil stencil = bake::Stencil::second_order;
    int side = k_usual_side;
};

lab::Study plan() {
    lab::Study study;
    study.about =
        "Shortest paths over water from a circle of radius 1, by fast marching. t is the length of a path, "
        "in radii; hits are nodes of the grid in the water, evaluations thousands of local solutions; "
        "a pixel is the spacing of the nodes.";
    for (const bake::KnownCase& known : bake::known_cases())
        study.views.push_back({std::string(known.description)});
    lab::Axis sides{"nodes a side", {}};
    for (const int side : k_study_sides)
        sides.values.push_back(fmt::format("{}", side));
    for (const bake::Stencil stencil : k_stencils)
        study.series.push_back({fmt::format("order {}", int(stencil)),
                                lab::Trust::unknown,
                                {{"order", fmt::format("{}", int(stencil))}},
                                {sides}});
    study.omissions = {
        "In all maps except open water, the middle, where the circle closes on itself, is left out."};
    return study;
}

/// Returns the settings of the points of plan(), in the order of lab::points_of: the default setting, then
/// all combinations.
std::vector<MarchSetting> march_settings() {
    std::vector<MarchSetting> settings{{}};
    for (const bake::Stencil stencil : k_stencils)
        for (const int side : k_study_sides)
            settings.push_back({stencil, side});
    return settings;
}

lab::Hits hits_of(std::vector<double> ways, double evaluations) {
    lab::Hits hits;
    hits.evaluations.assign(ways.size(), float(evaluations));
    hits.flags.assign(ways.size(), 0);
    hits.distance = std::move(ways);
    return hits;
}

/// Compares the marches of one setting with the exact results, case by case and together.
void hold_against_exact(const MarchSetting& setting, lab::WorkPrecision& point) {
    std::vector<lab::Hits> exact, found;
    std::vector<std::vector<double>> footprints; // hit_errors takes them at distance 1
    const auto outcome_of = [](const lab::Hits& truth, const lab::Hits& test,
                               const std::vector<double>& pixel) {
        lab::Outcome outcome;
        outcome.hits = lab::hit_errors(truth, test, pixel);
        outcome.causes = lab::count(lab::causes(truth, test));
        return outcome;
    };
    for (const bake::KnownCase& known : bake::known_cases()) {
        bake::MarchSample sample = bake::study_march(known, setting.side, setting.stencil);
        for (std::vector<double>& pixel = footprints.emplace_back(); const double way : sample.ways.exact)
            pixel.push_back(sample.spacing / std::max(way, 1e-9));
        const double thousands = 1e-3 * double(sample.work.updates);
        exact.push_back(hits_of(std::move(sample.ways.exact), 0));
        found.push_back(hits_of(std::move(sample.ways.found), thousands));
        point.views.push_back(outcome_of(exact.back(), found.back(), footprints.back()));
    }
    point.all = outcome_of(lab::joined(exact), lab::joined(found), lab::joined(footprints));
    point.compile_milliseconds = point.first_draw_milliseconds = std::nan("");
}

lab::WorkPrecisionSet march_set(const std::vector<MarchSetting>& settings) {
    lab::WorkPrecisionSet set;
    set.study = plan();
    set.words = {"RMS error of the path length, in radii", "thousands of local solutions",
                 "the bake's own setting"};
    set.circumstances = circumstances_now();
    set.circumstances.scene = "bake island";
    set.hit_standard = {"closed forms of the paths, in double: straight lines, tangents, arcs and corners",
                        1e-15, "some rounding errors of numbers up to 1"};
    std::vector<lab::Point> points = lab::points_of(set.study);
    for (size_t i = 0; i < points.size(); ++i) {
        set.points.emplace_back().point = std::move(points[i]);
        hold_against_exact(settings[i], set.points.back());
    }
    return set;
}

Result<int> write_march_report(const MarchStudyRequest& request) {
    Interrupt interrupt;
    const OutputPath folder = OutputPath::typed(request.folder);
    TRY(prepare_report(folder));
    const std::vector<MarchSetting> settings = march_settings();
    lab::Findings findings{march_set(settings), {}};
    std::vector<std::vector<std::function<void()>>> marches;
    for (const MarchSetting& setting : settings)
        for (auto& of_point = marches.emplace_back(); const bake::KnownCase& known : bake::known_cases())
            of_point.push_back(bake::march_of(known, setting.side, setting.stencil));
    StudyWatcher watcher(interrupt);
    lab::Timing timing;
    timing.budget = request.budget;
    findings.set.circumstances.complete = lab::time_points(
        timing, watcher.watch(),
        [&](size_t point, size_t view, bool) {
            const lab::Stopwatch watch;
            marches[point][view]();
            return lab::Cost{watch.elapsed(), {}};
        },
        findings.set);
    watcher.finish();
    findings.set.circumstances.clock = "wall clock";
    lab::judge(findings.set);
    lab::observe_orders(findings.set);
    say_findings(findings.set, TRY(write_findings(folder, findings)));
    return interrupt.requested() ? Interrupt::k_exit_code : 0;
}

} // namespace

Result<int> study_march(const MarchStudyRequest& request) {
    TRY(put_tables());
    return request.folder.empty() ? 0 : write_march_report(request);
}

namespace fs = std::filesystem;
namespace {

struct IslandOptions {
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

} // namespace

void add_bake_island(Command bake_command, Action& chosen) {
    auto options = std::make_shared<IslandOptions>();
    Command island = bake_command.add_subcommand(
        "island",
        "Makes the texture of an island's sea: path distance of waves, wave mask, depth and height");
    island
        .add_option(
            "-o,--output", options->output,
            "File, .exr or (with --depth float) .tif [island.exr]; with --study: folder for the report")
        .type_name("FILE");
    island
        .add_option(
            "--depth",
            [options](const std::string& depth) {
                options->depth = depth == "half" ? image::SampleDepth::half : image::SampleDepth::f32;
            },
            "Bits per channel [half]")
        .check(one_of({"half", "float"}))
        .type_name("half|float");
    const Option side = island.add_option("--size", options->side, "Texels per side of the generated island")
                            .check(number<int>(fmt::format("a whole number from {} to {}", bake::k_least_side,
                                                           bake::k_largest_side),
                                               bake::k_least_side, bake::k_largest_side))
                            .type_name("N")
                            .capture_default_str();
    const Option seed =
        island.add_option("--seed", options->seed, "Seed: each gives another island of the same kind")
            .capture_default_str();
    const Option heights = island
                               .add_option("--heights", options->heights,
                                           "Uses your own square height map instead (first channel)")
                               .type_name("FILE")
                               .excludes(side)
                               .excludes(seed);
    island.add_option("--extent", options->extent, "Length of a side of that map in metres")
        .needs(heights)
        .check(
            number(fmt::format("metres from 1 to {:g}", bake::k_largest_metres), 1.0, bake::k_largest_metres))
        .type_name("M")
        .capture_default_str();
    island.add_option("--sea", options->sea, "Value of that map at sea level")
        .needs(heights)
        .check(number("a number from -1e6 to 1e6", -1e6, 1e6))
        .type_name("V")
        .capture_default_str();
    island.add_option("--metres", options->metres, "Height in metres that a value of 1 stands for")
        .needs(heights)
        .check(number("metres from 1e-6 to 1e6", 1e-6, 1e6))
        .type_name("M")
        .capture_default_str();
    const Option study = island.add_flag(
        "--study", options->study,
        "Prints error against run time on maps with known answers; with -o FOLDER also writes a report");
    island
        .add_option("--budget", options->march_study.budget, "Seconds to spend on the timing of that report")
        .needs(study)
        .check(number("seconds from 0.01 to 1e6", 0.01, 1e6))
        .type_name("S")
        .capture_default_str();
    island.on_call([options, &chosen] {
        chosen = [options] {
            options->march_study.folder = options->output;
            return options->study ? study_march(options->march_study) : bake(*options);
        };
    });
}

namespace {

struct BakeOptions {
    fs::path output{}; ///< empty: the command's default
    uint32_t seed = image::k_noise_seed;
};

Result<int> write(const OutputPath& output, const image::Image& image) {
    const fs::path& path = output.path();
    TRY(image::check_picture_name(path));
    const auto depth =
        image.type == image::SampleType::f32 ? image::SampleDepth::u16 : image::natural_depth(path);
    const image::PictureFormat format{depth, {{"Software", "tidemark bake"}}};
    TRY(image::write_picture(output, image, format));
    say(fmt::format("wrote {}", path.string()));
    return 0;
}

Result<int> bake_noise(const BakeOptions& options) {
    return write(OutputPath::typed_or(options.output, "noise.png"), image::make_noise(options.seed));
}

Result<int> bake_ramps(const BakeOptions& options) {
    for (const bake::NamedImage& ramp : bake::make_ramps())
        if (auto written = write(OutputPath::typed(options.output) / (ramp.name + ".png"), ramp.image);
            !written)
            return written;
    return 0;
}

} // namespace

void add_bake(Command app, Action& chosen) {
    Command command = app.add_subcommand("bake", "Makes the textures that scenes need");
    command.require_subcommand();

    auto noise = std::make_shared<BakeOptions>();
    Command noise_command =
        command.add_subcommand("noise", "Makes the 256x256 noise texture that channels read by default");
    noise_command.add_option("-o,--output", noise->output, "File [noise.png]").type_name("FILE");
    noise_command.add_option("--seed", noise->seed, "Seed: each gives another noise of the same kind")
        .check(number<uint32_t>("a whole number from 0"))
        .type_name("N")
        .capture_default_str();
    noise_command.on_call([noise, &chosen] { chosen = [noise] { return bake_noise(*noise); }; });

    auto ramps = std::make_shared<BakeOptions>();
    ramps->output = ".";
    Command ramps_command = command.add_subcommand(
        "ramps", "Makes the ramps of shaders/pseudo3d_water.glsl and stylized_waves.glsl");
    ramps_command.add_option("-o,--output", ramps->output, "Folder")
        .type_name("FOLDER")
        .capture_default_str();
    ramps_command.on_call([ramps, &chosen] { chosen = [ramps] { return bake_ramps(*ramps); }; });

    add_bake_island(command, chosen);
}

} // namespace tidemark::cli
