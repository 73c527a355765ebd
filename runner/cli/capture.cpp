#include "cli/capture_run.hpp"
#include "cli/capture_sound.hpp"
#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/interrupt.hpp"
#include "cli/options.hpp"
#include "platform/headless_context.hpp"
#include "render/renderer.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <memory>
#include <thread>
#include <unordered_set>

namespace tidemark::cli {
namespace {

using image::SampleDepth;
using image::SampleType;

struct CaptureOptions {
    SceneRequest scene;
    FrameOptions frames;
    std::string output;
    std::string depth;
    std::string device = "auto";
    std::optional<double> timeout;
    double duration = 60;
    bool json = false;
};

std::string default_output(const CaptureOptions& options, size_t frame_count) {
    return options.scene.path.stem().string() + (frame_count > 1 ? ".%04d.png" : ".png");
}

Result<SampleDepth> parse_depth(const std::string& text, const OutputName& output) {
    constexpr std::pair<std::string_view, SampleDepth> k_depths[] = {{"8", SampleDepth::u8},
                                                                     {"16", SampleDepth::u16},
                                                                     {"half", SampleDepth::half},
                                                                     {"float", SampleDepth::f32}};
    if (output.standard_output() && !text.empty())
        return fail(ErrorCode::usage, "--depth: raw frames on standard output always have 8 bits");
    if (text.empty())
        return output.standard_output() ? SampleDepth::u8 : image::natural_depth(output.pattern());
    for (const auto& [name, depth] : k_depths)
        if (name == text)
            return depth;
    return fail(ErrorCode::usage, fmt::format("--depth {}: give 8, 16, half or float", text));
}

/// A frame that is named twice (`0-9,5-14`) is one file.
void drop_repeats(std::vector<int>& frames) {
    std::unordered_set<int> seen;
    std::erase_if(frames, [&](int frame) { return !seen.insert(frame).second; });
}

Result<CapturePlan> plan_capture(const CaptureOptions& options) {
    auto frames = resolve(options.frames);
    if (!frames)
        return fail(std::move(frames.error()));
    if (options.output != "-")
        drop_repeats(frames->frames);
    const size_t count = frames->frames.size();
    auto output =
        OutputName::parse(options.output.empty() ? default_output(options, count) : options.output, count);
    if (!output)
        return fail(std::move(output.error()));
    const auto depth = parse_depth(options.depth, *output);
    if (!depth)
        return fail(depth.error());
    if (!output->standard_output())
        if (auto known = image::check_picture_format(output->pattern(), *depth); !known)
            return fail(std::move(known.error()));
    if (options.timeout && !(*options.timeout > 0))
        return fail(ErrorCode::usage, "--timeout: give a number of seconds above 0");
    return CapturePlan{*std::move(frames), *std::move(output), *depth, options.timeout, options.json};
}

Result<render::Renderer> compile(scene::Scene scene, const CaptureOptions& options, const CapturePlan& plan,
                                 Interrupt& interrupt) {
    const Interrupt::Immediate at_once(interrupt);
    Watchdog watchdog;
    const Watchdog::Watch watch(watchdog, "compiling", std::nullopt);
    const SampleType samples = plan.depth == SampleDepth::u8 ? SampleType::u8 : SampleType::f32;
    return render::Renderer::create(
        std::move(scene), {plan.frames.extent, samples, options.frames.pass, precision_of(options.scene)});
}

void say_what_was_written(const std::vector<FrameRecord>& records) {
    if (records.size() == 1)
        say(fmt::format("wrote {}", records.front().file));
    else if (!records.empty())
        say(fmt::format("wrote {} frames, {} to {}", records.size(), records.front().file,
                        records.back().file));
}

/// `-o x.wav` asks for the sound of a scene instead of its pictures.
bool wants_sound(const CaptureOptions& options) {
    return std::filesystem::path(options.output).extension() == ".wav";
}

Result<int> capture(const CaptureOptions& options) {
    if (wants_sound(options))
        return capture_sound(options.scene, {options.output, options.device, options.duration});
    const auto plan = plan_capture(options);
    if (!plan)
        return fail(plan.error());
    if (options.json && plan->output.standard_output())
        return fail(ErrorCode::usage, "--json and -o - both want standard output: give one of them");
    Interrupt interrupt;
    std::jthread codec; // is loaded beside the driver, which takes as long
    if (!plan->output.standard_output())
        codec = image::preload_picture_codec(plan->output.pattern());
    auto scene = load(options.scene);
    if (!scene)
        return fail(std::move(scene.error()));
    const auto context = platform::HeadlessContext::create(options.device);
    if (!context)
        return fail(context.error());
    auto renderer = compile(*std::move(scene), options, *plan, interrupt);
    if (!renderer)
        return fail(std::move(renderer.error()));
    Capture run(*plan, *renderer);
    const auto complete = run.run(interrupt);
    if (!complete)
        return fail(complete.error());
    if (options.json)
        if (auto printed = put(run.report().dump(2) + "\n"); !printed)
            return fail(std::move(printed.error()));
    if (!options.json && !plan->output.standard_output())
        say_what_was_written(run.records());
    if (!*complete)
        say(fmt::format("interrupted after {} of {} frames", run.records().size(),
                        plan->frames.frames.size()));
    return *complete ? 0 : Interrupt::k_exit_code;
}

} // namespace

void add_capture(CLI::App& app, Action& chosen) {
    auto options = std::make_shared<CaptureOptions>();
    CLI::App* command = app.add_subcommand("capture", "Makes frames with no display");
    add_scene_options(*command, options->scene);
    add_precision_options(*command, options->scene);
    add_picture_options(*command, options->frames);
    add_time_options(*command, options->frames);
    command
        ->add_option(
            "-o,--output", options->output,
            "File: .png .jpg .tif .exr .hdr, a sequence with %04d or ####; - for raw RGB frames on standard "
            "output [SCENE.png]")
        ->type_name("OUT");
    command
        ->add_option("--depth", options->depth,
                     "Bits of a sample in the file [what the format stores by nature]")
        ->type_name("8|16|half|float");
    command
        ->add_option("--device", options->device, "Where to draw: a name from `tidemark inspect --devices`")
        ->type_name("NAME")
        ->capture_default_str();
    command
        ->add_option("--timeout", options->timeout,
                     "Give up on a frame that takes longer (compiling not counted)")
        ->type_name("SECONDS");
    command->add_option("--duration", options->duration, "Length of a .wav")
        ->type_name("SECONDS")
        ->capture_default_str();
    command->add_flag("--json", options->json, "One JSON object about the frames on standard output");
    command->callback([options, &chosen] { chosen = [options] { return capture(*options); }; });
}

} // namespace tidemark::cli
