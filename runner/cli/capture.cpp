#include "base/hash.hpp"
#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/frame_writer.hpp"
#include "cli/interrupt.hpp"
#include "cli/omissions.hpp"
#include "cli/options.hpp"
#include "cli/output_name.hpp"
#include "cli/progress.hpp"
#include "cli/version.hpp"
#include "gl/capabilities.hpp"
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
using Clock = std::chrono::steady_clock;

struct CaptureOptions {
    SceneRequest scene;
    FrameOptions frames;
    std::string output;
    std::string depth;
    std::string device = "auto";
    bool json = false;
};

/// What is known before anything is drawn.
struct CapturePlan {
    FrameRequest frames;
    OutputName output;
    SampleDepth depth = SampleDepth::u8;
};

/// One frame as `--json` reports it.
struct FrameRecord {
    render::FrameInputs inputs;
    std::string file;
    std::string sha256;
    double milliseconds = 0;
};

double milliseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

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
    return CapturePlan{*std::move(frames), *std::move(output), *depth};
}

/// Rows from the top down, RGB, as video tools take raw frames.
Result<void> put_raw(const image::Image& image) {
    const image::Image upright = image::flipped(image);
    const auto samples = upright.u8();
    std::vector<std::byte> rgb;
    rgb.reserve(image.extent.pixels() * 3);
    for (size_t pixel = 0; pixel < image.extent.pixels(); ++pixel)
        for (size_t channel = 0; channel < 3; ++channel)
            rgb.push_back(std::byte(samples[pixel * 4 + channel]));
    return put(rgb);
}

class Capture {
public:
    Capture(const CaptureOptions& options, const CapturePlan& plan, render::Renderer& renderer)
        : options_(options), plan_(plan), renderer_(renderer), driver_(gl::query_capabilities()) {}

    /// Draws and hands over every frame; true when all were made before an interrupt.
    Result<bool> draw_all(const Interrupt& interrupt);
    nlohmann::ordered_json report() const;
    const std::vector<FrameRecord>& records() const { return records_; }

private:
    FrameRecord draw(int frame, image::Image& image);
    Result<bool> deliver(const FrameRecord& record, image::Image image);
    image::PictureFormat format_of(const render::FrameInputs& inputs) const;

    const CaptureOptions& options_;
    const CapturePlan& plan_;
    render::Renderer& renderer_;
    gl::Capabilities driver_;
    std::unique_ptr<FrameWriter> writer_;
    std::vector<FrameRecord> records_;
};

Result<bool> Capture::draw_all(const Interrupt& interrupt) {
    // The driver keeps the cores busy while it draws: two encoders are enough to keep up with it.
    const auto workers = unsigned(std::min<size_t>(2, plan_.frames.frames.size()));
    if (!plan_.output.standard_output())
        writer_ = std::make_unique<FrameWriter>(workers);
    Progress progress("frames", plan_.frames.frames.size());
    bool complete = true;
    for (const int frame : plan_.frames.frames) {
        if (interrupt.requested()) {
            complete = false;
            break;
        }
        image::Image image;
        FrameRecord record = draw(frame, image);
        const auto wanted = deliver(record, std::move(image));
        if (!wanted)
            return fail(wanted.error());
        if (!*wanted)
            break;
        records_.push_back(std::move(record));
        progress.advance();
    }
    if (writer_)
        if (auto written = writer_->finish(); !written)
            return fail(std::move(written.error()));
    return complete;
}

FrameRecord Capture::draw(int frame, image::Image& image) {
    FrameRecord record;
    record.inputs = inputs_of(plan_.frames, frame);
    const auto start = Clock::now();
    renderer_.draw(record.inputs);
    image = renderer_.read_back();
    record.milliseconds = milliseconds_since(start);
    record.file = plan_.output.of_frame(frame).string();
    if (options_.json)
        record.sha256 = sha256(image.bytes);
    return record;
}

/// False when the writer has failed and no more frames are wanted.
Result<bool> Capture::deliver(const FrameRecord& record, image::Image image) {
    if (!writer_)
        return put_raw(image).map([] { return true; });
    return writer_->push({record.inputs.frame, record.file, std::move(image), format_of(record.inputs)});
}

image::PictureFormat Capture::format_of(const render::FrameInputs& inputs) const {
    return {plan_.depth,
            {{"Scene", options_.scene.path.string()},
             {"Frame", fmt::format("{}", inputs.frame)},
             {"iTime", fmt::format("{}", inputs.time)},
             {"Driver", fmt::format("{}, OpenGL {}", driver_.renderer, driver_.version)},
             {"Software", fmt::format("tidemark {}", k_version)}}};
}

nlohmann::ordered_json Capture::report() const {
    nlohmann::ordered_json report;
    report["tidemark"] = k_version;
    report["scene"] = options_.scene.path.string();
    report["size"] = {renderer_.extent().width, renderer_.extent().height};
    report["driver"] = driver_.version;
    report["renderer"] = driver_.renderer;
    report["left_out"] = facts_of(renderer_).left_out;
    report["frames"] = nlohmann::ordered_json::array();
    for (const FrameRecord& record : records_)
        report["frames"].push_back({{"frame", record.inputs.frame},
                                    {"iTime", record.inputs.time},
                                    {"file", record.file},
                                    {"sha256", record.sha256},
                                    {"milliseconds", record.milliseconds}});
    return report;
}

Result<int> capture(const CaptureOptions& options) {
    const auto plan = plan_capture(options);
    if (!plan)
        return fail(plan.error());
    if (options.json && plan->output.standard_output())
        return fail(ErrorCode::usage, "--json and -o - both want standard output: give one of them");
    const Interrupt interrupt;
    std::jthread codec; // is loaded beside the driver, which takes as long
    if (!plan->output.standard_output())
        codec = image::preload_picture_codec(plan->output.pattern());
    auto scene = load(options.scene);
    if (!scene)
        return fail(std::move(scene.error()));
    const auto context = platform::HeadlessContext::create(options.device);
    if (!context)
        return fail(context.error());
    const SampleType samples = plan->depth == SampleDepth::u8 ? SampleType::u8 : SampleType::f32;
    auto renderer = render::Renderer::create(*std::move(scene), {plan->frames.extent, samples});
    if (!renderer)
        return fail(std::move(renderer.error()));
    Capture run(options, *plan, *renderer);
    const auto complete = run.draw_all(interrupt);
    if (!complete)
        return fail(complete.error());
    if (options.json)
        if (auto printed = put(run.report().dump(2) + "\n"); !printed)
            return fail(std::move(printed.error()));
    if (!options.json && !run.records().empty() && !plan->output.standard_output())
        say(run.records().size() == 1 ? fmt::format("wrote {}", run.records().front().file)
                                      : fmt::format("wrote {} frames, {} to {}", run.records().size(),
                                                    run.records().front().file, run.records().back().file));
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
    command->add_flag("--json", options->json, "One JSON object about the frames on standard output");
    command->callback([options, &chosen] { chosen = [options] { return capture(*options); }; });
}

} // namespace tidemark::cli
