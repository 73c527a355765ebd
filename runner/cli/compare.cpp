#include "base/error.hpp"
#include "cli/commands.hpp"
#include "cli/inspect.hpp"
#include "host/command_line.hpp"
#include "host/console.hpp"
#include "host/frame_files.hpp"
#include "host/json.hpp"
#include "media/comparison.hpp"
#include "media/picture_file.hpp"
#include "scene/load_scene.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>

namespace tidemark::cli {

using namespace host;
namespace {

using image::PictureMetrics;

/// One metric of a comparison: its names and the option that limits it.
struct Metric {
    const char* key;   ///< in JSON
    const char* label; ///< in text output
    const char* unit;
    const char* option;
    bool more_is_better;
    double (*of)(const PictureMetrics&);
};

constexpr Metric k_metrics[] = {
    {"rmse", "RMSE", "", "--max-rmse", false, [](const PictureMetrics& m) { return m.samples.rmse; }},
    {"psnr", "PSNR", " dB", "--min-psnr", true, [](const PictureMetrics& m) { return m.samples.psnr; }},
    {"relative_mse", "relative MSE", "", "--max-relative-mse", false,
     [](const PictureMetrics& m) { return m.samples.relative_mse; }},
    {"largest", "largest difference", "", "--max-difference", false,
     [](const PictureMetrics& m) { return m.samples.largest; }},
    {"ssim", "SSIM", "", "--min-ssim", true, [](const PictureMetrics& m) { return m.ssim; }},
    {"flip", "FLIP", "", "--max-flip", false, [](const PictureMetrics& m) { return m.flip; }},
    {"differing", "differing pixels", " %", "--max-differing", false,
     [](const PictureMetrics& m) { return 100.0 * m.samples.differing_share(); }},
};
constexpr size_t k_metric_count = std::size(k_metrics);

struct CompareOptions {
    std::string reference;
    std::string test;
    std::string output;
    std::string map = "difference";
    std::optional<double> gain;
    double tolerance = 0.0;
    std::array<std::optional<double>, k_metric_count> limits{};
    bool json = false;
    std::vector<std::string> devices; ///< of --devices: compares scenes, not pictures
    std::vector<std::string> more_scenes;
    std::string size = "320x180";
    double time = 10;
};

/// Two pictures of the same frame.
struct Pair {
    std::optional<int> frame;
    std::filesystem::path reference;
    std::filesystem::path test;

    std::string label() const { return frame ? fmt::format("frame {}: ", *frame) : ""; }
};

/// Pairs the pictures by frame. Every frame of either sequence must be in the other; two single files are a
/// pair whatever their names.
Result<std::vector<Pair>> pairs_of(const CompareOptions& options) {
    const auto reference = find_sequence(options.reference), test = find_sequence(options.test);
    for (const auto* side : {&reference, &test})
        if (!*side)
            return fail(side->error());
    const bool numbered = reference->begin()->first.has_value();
    if (numbered != test->begin()->first.has_value())
        return fail(ErrorCode::usage,
                    fmt::format("'{}' is a sequence and '{}' is one picture: give two of the same kind",
                                numbered ? options.reference : options.test,
                                numbered ? options.test : options.reference));
    std::vector<Pair> pairs;
    for (const auto& [frame, file] : *reference) {
        const auto other = test->find(frame);
        if (other == test->end())
            return fail(ErrorCode::check_failed,
                        fmt::format("frame {} is missing: '{}' has no counterpart in '{}'", *frame,
                                    file.string(), options.test));
        pairs.push_back({frame, file, other->second});
    }
    for (const auto& [frame, file] : *test)
        if (!reference->contains(frame))
            return fail(ErrorCode::check_failed,
                        fmt::format("frame {} is missing: '{}' has no counterpart in '{}'", *frame,
                                    file.string(), options.reference));
    return pairs;
}

std::vector<std::filesystem::path> pictures_of(const std::vector<Pair>& pairs) {
    std::vector<std::filesystem::path> pictures;
    for (const Pair& pair : pairs)
        pictures.insert(pictures.end(), {pair.reference, pair.test});
    return pictures;
}

Result<void> check(const CompareOptions& options) {
    if (!(options.tolerance >= 0.0))
        return fail(ErrorCode::usage, "--tolerance: give a number from 0 up, as a part of the peak");
    if (options.gain && !(*options.gain > 0.0))
        return fail(ErrorCode::usage, "--gain: give a number above 0");
    return {};
}

/// Returns a message for each limit that a comparison exceeds. A NaN exceeds every limit, and so does a pair
/// in which one picture has a NaN or an infinity and the other has a different value there.
std::vector<std::string> failures(const CompareOptions& options, const Pair& pair,
                                  const PictureMetrics& metrics) {
    const bool no_number = std::isnan(metrics.samples.rmse);
    std::vector<std::string> lines;
    for (size_t i = 0; i < k_metric_count; ++i) {
        const Metric& metric = k_metrics[i];
        const auto& limit = options.limits[i];
        const double value = metric.of(metrics);
        if (!limit)
            continue;
        if (metric.key == std::string_view("ssim") && std::isnan(value) && !no_number) {
            if (metrics.samples.largest != 0) // equal pictures have an SSIM of 1, whatever their size
                lines.push_back(fmt::format("{}SSIM needs pictures of at least {} pixels a side: use "
                                            "--min-psnr or --max-rmse instead of {}",
                                            pair.label(), image::k_ssim_window, metric.option));
            continue;
        }
        const bool within = metric.more_is_better ? value >= *limit : value <= *limit;
        if (within && !no_number)
            continue;
        lines.push_back(
            fmt::format("{}{} {:.6g}{} is {} {} {:.6g}{}", pair.label(), metric.label, value, metric.unit,
                        within || std::isnan(value) ? "not within"
                        : metric.more_is_better     ? "below"
                                                    : "above",
                        metric.option, *limit,
                        no_number ? ": NaN or infinity where the other picture has another value" : ""));
    }
    return lines;
}

std::string text_of(const Pair& pair, const PictureMetrics& metrics, const std::string& note) {
    std::string line = pair.label();
    const image::PictureDifference& samples = metrics.samples;
    for (const Metric& metric : k_metrics) {
        const double value = metric.of(metrics);
        const bool too_small =
            metric.key == std::string_view("ssim") && std::isnan(value) && !std::isnan(samples.rmse);
        line += (&metric == k_metrics ? "" : ", ") +
                (too_small ? fmt::format("no {} below {} pixels a side", metric.label, image::k_ssim_window)
                           : fmt::format("{} {:.6g}{}", metric.label, value, metric.unit));
    }
    if (samples.one_non_finite + samples.both_non_finite > 0)
        line += fmt::format("; pixels with NaN or infinity: {} in one picture only, {} in both",
                            samples.one_non_finite, samples.both_non_finite);
    if (!note.empty())
        line += "; " + note;
    return line + '\n';
}

/// JSON has no infinity and no NaN: they become null, and `equal` and `non_finite` distinguish the cases.
Json json_of(const Pair& pair, const PictureMetrics& metrics, const std::string& note) {
    Json json;
    if (pair.frame)
        json["frame"] = *pair.frame;
    json["reference"] = pair.reference.string();
    json["test"] = pair.test.string();
    for (const Metric& metric : k_metrics) {
        const double value = metric.of(metrics);
        json[metric.key] = std::isfinite(value) ? Json(value) : Json(nullptr);
    }
    json["equal"] = metrics.samples.equal();
    json["non_finite"] = {{"one", metrics.samples.one_non_finite}, {"both", metrics.samples.both_non_finite}};
    if (!note.empty())
        json["note"] = note;
    return json;
}

/// Writes the difference picture at the natural sample depth of its file format.
Result<void> write_map(const CompareOptions& options, const OutputPath& output, const image::Image& reference,
                       const image::Image& test) {
    const image::SampleDepth depth = image::natural_depth(output.path());
    const double gain = options.gain.value_or(depth == image::SampleDepth::u8 ? 8.0 : 1.0);
    const image::Image picture = options.map == "flip" ? image::heat_map(image::flip(reference, test).map)
                                                       : image::difference_picture(reference, test, gain);
    return image::write_picture(output, picture, {depth});
}

Result<int> compare_devices(const CompareOptions& options) {
    if (options.devices.size() != 2)
        return fail(ErrorCode::usage, "--devices: give two devices, such as surfaceless,mesa:zink");
    DevicesRequest request{
        {options.devices[0], options.devices[1]}, {}, {}, {}, options.output, options.json};
    request.sequence.state.extent = TRY(parse_size(options.size));
    request.sequence.state = render::at_time(options.time, request.sequence.state);
    std::vector<std::filesystem::path> paths{options.reference};
    if (!options.test.empty())
        paths.emplace_back(options.test);
    paths.insert(paths.end(), options.more_scenes.begin(), options.more_scenes.end());
    request.scenes = scene::scenes_of(paths);
    return compare_on_devices(request);
}

Result<int> compare(const CompareOptions& options) {
    if (!options.devices.empty())
        return compare_devices(options);
    TRY(check(options));
    if (options.test.empty())
        return fail(ErrorCode::usage, "compare: give two pictures, or --devices X,Y and scenes");
    if (!options.more_scenes.empty())
        return fail(ErrorCode::usage, "compare: more than two pictures; scenes need --devices X,Y");
    const auto pairs = TRY(pairs_of(options));
    std::optional<OutputName> output;
    if (!options.output.empty()) {
        if (options.output == "-")
            return fail(ErrorCode::usage,
                        "-o: the difference picture cannot go to standard output; give a file");
        TRY(image::check_picture_name(options.output));
        output = TRY(OutputName::parse(options.output, pairs.size()));
        output->spare(pictures_of(pairs));
        for (const Pair& pair : pairs)
            TRY(output->of_frame(pair.frame.value_or(0)).place());
    }
    Json json = {{"tidemark", k_version}, {"frames", Json::array()}};
    std::string text;
    std::vector<std::string> beyond;
    for (const Pair& pair : pairs) {
        auto reference = image::read_picture(pair.reference), test = image::read_picture(pair.test);
        for (const auto* side : {&reference, &test})
            if (!*side)
                return fail(side->error());
        const image::SameChannels same = image::same_channels(*std::move(reference), *std::move(test));
        const auto metrics = image::measure(same.left, same.right, options.tolerance);
        if (!metrics)
            return fail(ErrorCode::check_failed,
                        fmt::format("{}'{}' and '{}': {}", pair.label(), pair.reference.string(),
                                    pair.test.string(), metrics.error().message));
        if (output)
            TRY(write_map(options, output->of_frame(pair.frame.value_or(0)), same.left, same.right));
        text += text_of(pair, *metrics, same.note);
        json["frames"].push_back(json_of(pair, *metrics, same.note));
        for (std::string& line : failures(options, pair, *metrics))
            beyond.push_back(std::move(line));
    }
    json["failures"] = beyond;
    TRY(put(options.json ? dump(json, 2) + "\n" : text));
    for (const std::string& line : beyond)
        say(line);
    return beyond.empty() ? 0 : exit_code(ErrorCode::check_failed);
}

} // namespace

void add_compare(Command app, Action& chosen) {
    auto options = std::make_shared<CompareOptions>();
    Command command = app.add_subcommand("compare", "Measures how much two pictures or two sequences differ");
    command.add_option("A", options->reference, "Reference: a picture, or a sequence with %04d or ####")
        .required();
    command.add_option("B", options->test, "Picture or sequence to compare with the reference");
    command.add_option("SCENES", options->more_scenes,
                       "With --devices: A, B and these are scenes or folders of scenes");
    command
        .add_option("--devices", options->devices,
                    "Draws scenes on two devices and explains the differences; names from `tidemark inspect "
                    "--devices`")
        .type_name("X,Y")
        .delimiter(',')
        .one_word();
    command.add_option("--size", options->size, "With --devices: size of the pictures")
        .type_name("WxH")
        .capture_default_str();
    command.add_option("--time", options->time, "With --devices: seconds at which the scenes are drawn")
        .type_name("T")
        .capture_default_str();
    command
        .add_option("-o,--output", options->output,
                    "Writes a difference picture: .png .jpg .tif .exr .hdr, %04d or #### for a sequence; "
                    "with --devices "
                    "a folder with a page")
        .type_name("OUT");
    command
        .add_option("--map", options->map,
                    "What the difference picture shows: |A - B|, or FLIP in false colours")
        .type_name("difference|flip")
        .check(one_of({"difference", "flip"}))
        .capture_default_str();
    command
        .add_option("--gain", options->gain,
                    "Factor for |A - B| in that picture [8; 1 for files with floats]")
        .type_name("G");
    command
        .add_option("--tolerance", options->tolerance,
                    "A pixel counts as different if a sample differs by more than this part of the peak")
        .type_name("D")
        .capture_default_str();
    for (size_t i = 0; i < k_metric_count; ++i)
        command
            .add_option(k_metrics[i].option, options->limits[i],
                        fmt::format("Exit code 1 if {} is {} this", k_metrics[i].label,
                                    k_metrics[i].more_is_better ? "below" : "above"))
            .type_name("X")
            .check(number<double>("a number"));
    command.add_flag("--json", options->json, "Prints one JSON object");
    command.on_call([options, &chosen] { chosen = [options] { return compare(*options); }; });
}

} // namespace tidemark::cli
