#include "cli/capture_run.hpp"

#include "base/hash.hpp"
#include "cli/console.hpp"
#include "cli/omissions.hpp"
#include "cli/precision_report.hpp"
#include "cli/progress.hpp"
#include "cli/version.hpp"
#include "image/cubemap_file.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>

namespace tidemark::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// Blocks of up to so many bytes are kept by the process: a frame of 4K in bytes.
constexpr int k_kept_bytes = 32 << 20;

double milliseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Rows from the top down, RGB, as video tools take raw frames.
Result<void> put_raw(const image::Image& image) {
    std::vector<std::byte> rgb(image.extent.pixels() * 3);
    std::byte* to = rgb.data();
    for (size_t row = size_t(image.extent.height); row-- > 0;) {
        const std::byte* from = &image.bytes[row * image.row_bytes()];
        for (int x = 0; x < image.extent.width; ++x, from += 4, to += 3)
            std::copy_n(from, 3, to);
    }
    return put(rgb);
}

} // namespace

Capture::Capture(const CapturePlan& plan, render::Renderer& renderer, std::filesystem::path sound)
    : plan_(plan), renderer_(renderer), driver_(gl::query_capabilities()),
      stepper_(renderer, [this](int frame) { return inputs_at(frame); }), sound_(std::move(sound)),
      watchdog_([this] { rescue_output(); }) {
    if (plan.frames.input)
        replay_.emplace(*plan.frames.input, plan.frames.camera);
}

render::FrameInputs Capture::inputs_at(int frame) {
    render::FrameInputs inputs = inputs_of(plan_.frames, frame);
    if (replay_)
        replay_->fill(inputs, renderer_.extent().height);
    return inputs;
}

Result<bool> Capture::run(Interrupt& interrupt) {
    // A frame's memory serves the next frame, instead of going back to the system and being cleared anew.
    ::mallopt(M_MMAP_THRESHOLD, k_kept_bytes);
    ::mallopt(M_TRIM_THRESHOLD, k_kept_bytes);
    if (auto opened = open_output(); !opened)
        return fail(std::move(opened.error()));
    prepare(interrupt);
    Progress progress("frames", plan_.frames.frames.size());
    for (const int frame : plan_.frames.frames) {
        image::Image image;
        FrameRecord record;
        if (draw(frame, interrupt, record, image) == Outcome::interrupted) {
            video_.reset(); // whole or not at all
            return close_output().map([] { return false; });
        }
        auto wanted = deliver(record, std::move(image));
        if (!wanted)
            return wanted;
        if (!*wanted)
            break;
        records_.push_back(std::move(record));
        progress.advance();
    }
    return close_output().map([] { return true; });
}

Result<void> Capture::open_output() {
    if (plan_.output.six_faces() && renderer_.shown_pass().kind != scene::PassKind::cubemap)
        return fail(ErrorCode::usage,
                    fmt::format("-o {}: {{}} stands for a face of a cube: give --pass \"Cube A\"",
                                plan_.output.pattern().string()));
    if (plan_.output.video()) {
        const bool cube = renderer_.shown_pass().kind == scene::PassKind::cubemap;
        auto video =
            image::VideoWriter::create(plan_.output.pattern(), {cube ? image::k_panorama : renderer_.extent(),
                                                                plan_.frames.fps, sound_});
        if (!video)
            return fail(std::move(video.error()));
        video_.emplace(*std::move(video));
    } else if (!plan_.output.standard_output()) {
        // The driver keeps the cores busy while it draws: two encoders are enough to keep up with it.
        writer_ = std::make_unique<FrameWriter>(unsigned(std::min<size_t>(2, plan_.frames.frames.size())));
    }
    return {};
}

Result<void> Capture::close_output() {
    if (video_)
        return video_->finish();
    return writer_ ? writer_->finish() : Result<void>();
}

/// What the driver puts off until the first draw, so that no frame pays for it, in time or against its limit.
void Capture::prepare(Interrupt& interrupt) {
    const Interrupt::Immediate at_once(interrupt);
    const Watchdog::Watch watch(watchdog_, "preparing the first frame", std::nullopt);
    const auto start = Clock::now();
    renderer_.warm_up(inputs_at(plan_.frames.frames.front()));
    prepare_milliseconds_ = milliseconds_since(start);
}

Capture::Outcome Capture::draw(int frame, const Interrupt& interrupt, FrameRecord& record,
                               image::Image& image) {
    std::optional<Watchdog::Watch> watch;
    std::optional<Progress> steps;
    Clock::time_point start;
    record.inputs = inputs_at(frame);
    const bool drawn = stepper_.draw(record.inputs.frame, [&](int step, int last) {
        if (interrupt.requested())
            return false;
        if (step < last && !steps)
            steps.emplace("frames stepped", size_t(last - step));
        else if (steps)
            steps->advance();
        watch.emplace(watchdog_, fmt::format("drawing frame {}", step), plan_.timeout);
        start = Clock::now();
        return true;
    });
    if (!drawn)
        return Outcome::interrupted;
    image = read_back();
    record.milliseconds = milliseconds_since(start);
    record.file = plan_.output.of_frame(frame).string();
    if (plan_.hashes)
        record.sha256 = sha256(image.bytes);
    return Outcome::drawn;
}

/// A cube is saved as the panorama that ShaderToy exports, or as its faces, which are one picture until then.
image::Image Capture::read_back() const {
    if (renderer_.shown_pass().kind != scene::PassKind::cubemap)
        return renderer_.read_back();
    const image::CubeFaces faces = renderer_.read_back_cube();
    return plan_.output.six_faces() ? image::column_of(faces) : image::equirectangular_of(faces);
}

/// On the watchdog's thread, while the main one is stuck in the driver: the frames that were drawn are saved,
/// half a video is not.
void Capture::rescue_output() {
    video_.reset();
    if (writer_)
        (void)writer_->finish();
}

/// False when the writer has failed and no more frames are wanted.
Result<bool> Capture::deliver(const FrameRecord& record, image::Image image) {
    if (video_)
        return video_->push(image).map([] { return true; });
    if (!writer_)
        return put_raw(image).map([] { return true; });
    if (!plan_.output.six_faces())
        return writer_->push({record.inputs.frame, record.file, std::move(image), format_of(record.inputs)});
    const auto faces = image::cube_of_picture(image);
    bool wanted = faces.has_value();
    for (size_t i = 0; wanted && i < faces->size(); ++i)
        wanted = writer_->push({record.inputs.frame, file_of_face(record.file, i),
                                image::flipped((*faces)[i]), format_of(record.inputs)});
    return wanted;
}

image::PictureFormat Capture::format_of(const render::FrameInputs& inputs) const {
    return {plan_.depth,
            {{"Scene", renderer_.scene().file.string()},
             {"Frame", fmt::format("{}", inputs.frame)},
             {"iTime", fmt::format("{}", inputs.time)},
             {"Precision", name_of(renderer_.precision())},
             {"Driver", fmt::format("{}, OpenGL {}", driver_.renderer, driver_.version)},
             {"Software", fmt::format("tidemark {}", k_version)}}};
}

nlohmann::ordered_json Capture::report() const {
    nlohmann::ordered_json report;
    report["tidemark"] = k_version;
    report["scene"] = renderer_.scene().file.string();
    report["size"] = {renderer_.extent().width, renderer_.extent().height};
    report["driver"] = driver_.version;
    report["renderer"] = driver_.renderer;
    report["pass"] = renderer_.shown_pass().name;
    add_precision(report, renderer_);
    report["prepare_milliseconds"] = prepare_milliseconds_;
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

} // namespace tidemark::cli
