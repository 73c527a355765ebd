#include "cli/capture_run.hpp"

#include "base/error.hpp"
#include "base/supervision.hpp"
#include "cli/capture_output.hpp"
#include "cli/capture_resume.hpp"
#include "host/console.hpp"
#include "host/scene_report.hpp"
#include "host/version.hpp"
#include "media/file_samples.hpp"
#include "media/image.hpp"
#include "media/texture_files.hpp"
#include "render/exposure.hpp"
#include "render/gl_context.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <malloc.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <iterator>

namespace tidemark::cli {
namespace {

/// Freed blocks up to this size stay in the process: a 4K frame of bytes.
constexpr int k_kept_bytes = 32 << 20;

double milliseconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

} // namespace

Capture::Capture(const CapturePlan& plan, Fingerprint fingerprint, Trial& compiled,
                 std::filesystem::path sound)
    : plan_(plan), fingerprint_(std::move(fingerprint)), renderer_(compiled.renderer),
      in_doubt_(compiled.in_doubt), driver_(gl::query_capabilities()), states_(states_of(plan.frames)),
      stepper_(renderer_, states_), saver_(plan, fingerprint_, renderer_), sound_(std::move(sound)),
      records_(plan.json || plan.sheet.has_value()), watchdog_([this] { rescue_output(); }) {}

Result<bool> Capture::run(Interrupt& interrupt) {
    interrupt_ = &interrupt;
    // Reuses a frame's memory for the next frame, instead of returning it to the system, which would clear it
    // again.
    ::mallopt(M_MMAP_THRESHOLD, k_kept_bytes);
    ::mallopt(M_TRIM_THRESHOLD, 4 * k_kept_bytes); // including its copies on the way to a file
    TRY(open_output());
    if (draws_ahead())
        ahead_.emplace(renderer_, watchdog_, plan_.timeout);
    if (!plan_.frames.frames.empty()) {
        Doing::note_frame(DoingPage::Frame{plan_.frames.frames.front(), true});
        prepare(interrupt);
        TRY(check_driver("preparing the first frame"));
        restore();
        if (in_doubt_ && !plan_.output.standard_output())
            TRY(saver_.save_program());
    }
    const bool resumable = can_be_resumed(plan_);
    Progress progress("frames", plan_.frames.frames.size());
    for (const int frame : plan_.frames.frames) {
        Doing::note_frame(DoingPage::Frame{frame, true});
        if (resumable && whole_frames() > 0)
            Doing::note_resumable();
        const auto outcome = TRY(make(frame, interrupt));
        if (outcome == Outcome::interrupted) {
            TRY(hand_over_all_ahead());
            if (video_)
                video_->drop();
            else if (!sheet_)
                TRY(close_output());
            if (whole_frames() == 0 && !plan_.output.standard_output())
                remove_states(plan_.output);
            return false;
        }
        if (outcome == Outcome::unwanted)
            break;
        progress.advance();
    }
    TRY(hand_over_all_ahead());
    Doing::note_frame({});
    if (plan_.loop && whole_frames() > 0)
        TRY(close_loop(interrupt));
    TRY(close_output());
    if (plan_.shard && plan_.state_every > 0 && !plan_.frames.frames.empty() && renderer_.plan().feedback)
        TRY(saver_.save_buffers(plan_.frames.frames.back() + 1)); // the next shard may start from it
    return true;
}

/// Returns true if frames are written band by band. Otherwise the frame is in memory as a whole, also for
/// several samples in one tile, as videos need it.
bool Capture::in_bands() const {
    return renderer_.tiles() && !(plan_.exposure.several() && renderer_.tiles()->count() == 1);
}

/// Returns false with --json, which reports each frame's own time, and if more is read of a frame than the
/// shown picture, or in another way.
bool Capture::draws_ahead() const {
    const scene::PassKind shown = renderer_.shown_pass().kind;
    const bool whole_in_memory =
        !in_bands() && !plan_.exposure.several() && shown != scene::PassKind::cubemap;
    const bool tells_non_finite =
        shown == scene::PassKind::image || renderer_.samples() == image::SampleType::f32;
    return plan_.frames.frames.size() > 1 && whole_in_memory && tells_non_finite && !plan_.layers &&
           !plan_.json && FramesAhead::pays(driver_.renderer);
}

Result<void> Capture::open_output() {
    if (plan_.output.video()) {
        const bool cube = renderer_.shown_pass().kind == scene::PassKind::cubemap;
        video_.emplace(
            TRY(SegmentedVideo::create(plan_, fingerprint_, cube ? image::k_panorama : renderer_.extent())));
    } else if (plan_.sheet) {
        sheet_.emplace(*plan_.sheet);
    } else if (!plan_.output.standard_output() && !in_bands()) {
        // Two encoders are enough: the driver keeps the cores busy while it draws.
        const auto encoders = unsigned(std::min<size_t>(2, plan_.frames.frames.size()));
        // Frames with all passes are large, so fewer wait.
        writer_ = std::make_unique<FrameWriter>(encoders, plan_.layers ? 1 : encoders + 1);
    }
    return {};
}

Result<void> Capture::close_output() {
    if (video_ && plan_.shard)
        return {}; // `gather` joins it
    if (video_)
        return encode("joining the video", {}, [&] { return video_->finish(sound_); });
    if (sheet_)
        return image::write_picture(plan_.output.of_frame(plan_.frames.frames.front()), sheet_->picture(),
                                    format_of_sheet());
    return writer_ ? writer_->finish() : Result<void>();
}

/// Does the work that drivers defer until the first draw, so that it does not count for a frame's time or
/// limit.
void Capture::prepare(Interrupt& interrupt) {
    const Interrupt::Immediate at_once(interrupt);
    const Watchdog::Watch watch(watchdog_, {"preparing the first frame", plan_.timeout});
    const auto start = Clock::now();
    renderer_.warm_up(inputs_of(states_(plan_.frames.frames.front())));
    prepare_milliseconds_ = milliseconds_since(start);
}

/// Restores the buffers of an earlier run; an unusable state is ignored.
void Capture::restore() {
    if (!start_ || !renderer_.plan().feedback || !renderer_.restore(start_->buffers))
        return;
    stepper_.start_from(start_->frame);
    saver_.found(start_->frame);
    say(fmt::format("continuing from the saved state before frame {}", start_->frame));
}

/// Draws the steps up to a frame; `work` stays watched. Returns false if interrupted.
Result<bool> Capture::step_to(int frame, const Interrupt& interrupt, FrameRecord& record, Work& work) {
    std::optional<Progress> steps;
    record.file = plan_.output.of_frame(frame).string();
    record.frame = frame;
    work.begun = Clock::now(); // the limit applies to the frame with all frames that lead to it
    Result<bool> saved = true;
    const auto steps_drawn = stepper_.draw(frame, [&](int step, int last) {
        if (interrupt.requested())
            return false;
        const bool long_way = step < last && !steps;
        saved = prepare_for(step, long_way);
        if (!saved || !*saved)
            return false;
        if (long_way)
            steps.emplace("frames stepped", size_t(last - step));
        else if (steps)
            steps->advance();
        work.start = Clock::now();
        work.watch.emplace(watchdog_, Watchdog::frame_task(step, plan_.timeout, work.begun));
        return true;
    });
    TRY(std::move(saved));
    record.passes_drawn = steps_drawn.passes;
    return steps_drawn.complete;
}

/// Delivers drawn frames before a long series of steps, and saves a state if one is due; a state is saved
/// only after all frames before it. Returns false if a frame could not be written and drawing is to stop.
Result<bool> Capture::prepare_for(int frame, bool long_way) {
    const bool due = saver_.is_due(frame);
    if ((due || long_way) && TRY(hand_over_all_ahead()) == Outcome::unwanted)
        return false;
    if (!due)
        return true;
    if (writer_ && !writer_->drain())
        return false;
    TRY(saver_.save_buffers(frame));
    return true;
}

/// Returns nothing if interrupted.
Result<std::optional<DrawnFrame>> Capture::draw(int frame, const Interrupt& interrupt) {
    DrawnFrame drawn;
    std::optional<Work> work(std::in_place);
    if (!TRY(step_to(frame, interrupt, drawn.record, *work)))
        return std::nullopt;
    auto picture = plan_.exposure.several() ? draw_samples(frame, interrupt) : read_back();
    if (!picture)
        return std::nullopt;
    TRY(check_driver(fmt::format("drawing frame {}", frame)));
    drawn.picture = *std::move(picture);
    drawn.record.milliseconds = milliseconds_since(work->start);
    work.reset();
    look_at(drawn);
    return drawn;
}

/// Checks the driver before pixels are used. On failure, earlier frames are written first.
Result<void> Capture::check_driver(const std::string& doing) {
    return gl::check_work(doing).map_error([&](Error error) {
        if (writer_)
            writer_->drain();
        error.message += "; try a smaller --size or --tile";
        return error;
    });
}

void Capture::look_at(DrawnFrame& drawn) {
    auto& [record, image] = drawn;
    record.not_finite = count_not_finite(renderer_, image);
    if (keeps_alpha())
        record.no_coverage = image::pixels_of_no_coverage(image);
    else if (plan_.depth == image::SampleDepth::u8)
        image = image::in_bytes(std::move(image));
    if (plan_.loop)
        loop_.see(image);
}

/// Draws the frame after the last one for the comparison; it is not written.
Result<bool> Capture::close_loop(const Interrupt& interrupt) {
    return TRY(draw(frame_behind(plan_.frames.frames), interrupt)).has_value();
}

Result<Capture::Outcome> Capture::make(int frame, const Interrupt& interrupt) {
    if (in_bands())
        return make_in_tiles(frame, interrupt);
    if (ahead_)
        return make_ahead(frame, interrupt);
    auto drawn = TRY(draw(frame, interrupt));
    return drawn ? hand_over(*std::move(drawn)) : Outcome::interrupted;
}

/// Draws the frame while earlier ones are read back and delivered.
Result<Capture::Outcome> Capture::make_ahead(int frame, const Interrupt& interrupt) {
    FrameRecord record;
    Work work;
    if (!TRY(step_to(frame, interrupt, record, work)))
        return Outcome::interrupted;
    work.watch.reset();
    std::optional<DrawnFrame> before;
    if (ahead_->full())
        before = ahead_->take();
    const bool added = ahead_->add(record, work.begun);
    auto outcome = before ? TRY(hand_over_ahead(*std::move(before))) : Outcome::made;
    if (added || outcome == Outcome::unwanted)
        return outcome;
    // The driver has no memory for one more, so frames are read back one by one from now on.
    outcome = TRY(hand_over_all_ahead());
    ahead_.reset();
    return outcome == Outcome::made ? hand_over_ahead({record, read_back()}) : outcome;
}

Result<Capture::Outcome> Capture::hand_over_ahead(DrawnFrame drawn) {
    TRY(check_driver(fmt::format("drawing frame {}", drawn.record.frame)));
    look_at(drawn);
    return hand_over(std::move(drawn));
}

Result<Capture::Outcome> Capture::hand_over_all_ahead() {
    auto outcome = Outcome::made;
    while (ahead_ && !ahead_->empty() && outcome == Outcome::made)
        outcome = TRY(hand_over_ahead(ahead_->take()));
    return outcome;
}

Result<Capture::Outcome> Capture::hand_over(DrawnFrame drawn) {
    if (plan_.json) {
        Sha256 hash;
        add_rows(hash, drawn.picture);
        drawn.record.sha256 = hash.digits();
    }
    if (!TRY(deliver(drawn.record, std::move(drawn.picture))))
        return Outcome::unwanted;
    records_.add(std::move(drawn.record));
    return Outcome::made;
}

/// Draws a frame in tiles. The time limit applies to the frame, the watchdog's messages to a tile.
Result<Capture::Outcome> Capture::make_in_tiles(int frame, const Interrupt& interrupt) {
    FrameRecord record;
    Work work;
    if (!TRY(step_to(frame, interrupt, record, work)))
        return Outcome::interrupted;
    work.watch.reset();
    auto output = TRY(open_bands(record));
    BandOutput& bands = *output;
    const render::ExposedFrame exposed = expose(plan_.exposure, states_(frame));
    Progress progress("tiles", renderer_.tiles()->count() * exposed.samples.size());
    const auto before_tile = [&] {
        if (work.watch)
            progress.advance();
        work.watch.reset();
        work.watch.emplace(watchdog_, Watchdog::frame_task(frame, plan_.timeout, work.start));
        return !interrupt.requested();
    };
    auto drawn = render::draw_bands(renderer_, exposed, before_tile, [&](image::Image band) {
        return check_driver(fmt::format("drawing frame {}", frame)).and_then([&] {
            return bands.take(std::move(band));
        });
    });
    if (drawn && *drawn) {
        progress.advance();
        drawn = bands.finish().map([] { return true; });
    }
    work.watch.reset();
    if (!TRY(std::move(drawn)))
        return Outcome::interrupted;
    record.milliseconds = milliseconds_since(work.start);
    record.sha256 = bands.sha256();
    record.not_finite = bands.not_finite();
    record.no_coverage = keeps_alpha() ? bands.no_coverage() : 0;
    records_.add(std::move(record));
    return Outcome::made;
}

Result<std::unique_ptr<BandOutput>> Capture::open_bands(const FrameRecord& record) const {
    std::optional<image::PictureStream> stream;
    if (!plan_.output.standard_output()) {
        const bool alpha = keeps_alpha() || renderer_.shown_pass().kind != scene::PassKind::image;
        stream.emplace(TRY(image::PictureStream::create(plan_.output.of_frame(record.frame),
                                                        renderer_.extent(), alpha, format_of(record))));
    }
    return std::make_unique<BandOutput>(std::move(stream), plan_.json);
}

/// Reads the picture back: a cube as the panorama that ShaderToy exports, or as its faces in one picture,
/// which is split later.
image::Image Capture::read_back() const {
    if (renderer_.shown_pass().kind != scene::PassKind::cubemap)
        return renderer_.read_back();
    const image::CubeFaces cube = renderer_.read_back_cube();
    return plan_.output.six_faces() ? image::column_of(cube) : image::equirectangular_of(cube);
}

/// Returns nothing if interrupted.
std::optional<image::Image> Capture::draw_samples(int frame, const Interrupt& interrupt) {
    const render::ExposedFrame exposed = expose(plan_.exposure, states_(frame));
    Progress progress("samples", exposed.samples.size());
    return draw_in_tiles(renderer_, exposed, [&] {
        progress.advance();
        return !interrupt.requested();
    });
}

size_t Capture::whole_frames() {
    constexpr size_t k_faces = 6;
    const size_t made = video_    ? video_->written()
                        : sheet_  ? size_t{0}
                        : writer_ ? writer_->written() / (plan_.output.six_faces() ? k_faces : 1)
                                  : records_.count();
    return plan_.kept.size() + made;
}

/// Saves the frames that were drawn; an incomplete segment of a video is dropped. Runs on the watchdog's
/// thread while the main thread is stuck in the driver.
void Capture::rescue_output() {
    // Otherwise the main thread is using it, and its encoder ends with our process.
    if (video_ && !in_encoder_)
        video_->drop();
    if (writer_)
        (void)writer_->finish();
    if (const std::string words = words_on_resuming(plan_, whole_frames()); !words.empty())
        say(words);
}

/// Runs work that waits for ffmpeg, which may hang: Ctrl-C then ends the process.
Result<void> Capture::encode(std::string what, std::optional<double> limit,
                             const std::function<Result<void>()>& work) {
    const Watchdog::Watch watch(watchdog_, {.what = std::move(what),
                                            .limit_seconds = limit,
                                            .unwanted = [this] { return interrupt_->requested(); }});
    in_encoder_ = true;
    auto outcome = work();
    in_encoder_ = false;
    return outcome;
}

/// Returns false if the writer has failed and drawing is to stop.
Result<bool> Capture::deliver(const FrameRecord& record, image::Image image) {
    if (video_) {
        auto encoded = encode(fmt::format("encoding frame {}", record.frame), plan_.timeout,
                              [&] { return video_->push(image); });
        return encoded.map([] { return true; }).map_error([&](Error error) {
            error.message += fmt::format(" (in frame {})", record.frame);
            return error;
        });
    }
    if (sheet_) {
        sheet_->add(image);
        return true;
    }
    if (!writer_)
        return put_raw(image).map([] { return true; });
    if (plan_.layers)
        return writer_->push(
            {record.frame, plan_.output.of_frame(record.frame), {}, {}, layers_of(record, std::move(image))});
    if (!plan_.output.six_faces())
        return writer_->push(
            {record.frame, plan_.output.of_frame(record.frame), std::move(image), format_of(record)});
    const auto faces = image::cube_of_picture(image);
    bool wanted = faces.has_value();
    for (size_t i = 0; wanted && i < faces->size(); ++i)
        wanted = writer_->push({record.frame, plan_.output.of_face(record.frame, i),
                                image::flipped((*faces)[i]), format_of(record)});
    return wanted;
}

std::vector<image::PictureLayer> Capture::layers_of(const FrameRecord& record, image::Image image) const {
    std::vector<image::PictureLayer> layers;
    layers.push_back({renderer_.shown_pass().name, std::move(image), format_of(record)});
    std::ranges::move(other_layers(renderer_, *plan_.layers), std::back_inserter(layers));
    return layers;
}

image::PictureFormat Capture::format_of(const FrameRecord& record) const {
    const render::FrameState state = states_(record.frame);
    // The fingerprint goes first: a JPEG without room for all metadata keeps the first entries.
    image::PictureFormat format{
        plan_.depth, {{k_fingerprint, fingerprint_.of_frame(state).text()}}, plan_.transfer, plan_.alpha};
    for (auto& fact : metadata_of(renderer_.scene(), moment_of(plan_.request, plan_.frames, state)))
        format.metadata.push_back(std::move(fact));
    const Extent extent = renderer_.extent();
    format.metadata.insert(format.metadata.end(),
                           {{"Size", fmt::format("{}x{}", extent.width, extent.height)},
                            {"Pass", renderer_.shown_pass().name},
                            {"Precision", name_of(renderer_.precision())},
                            {"Driver", fmt::format("{}, OpenGL {}", driver_.device(), driver_.version)}});
    if (keeps_alpha())
        format.metadata.emplace_back("Alpha",
                                     plan_.alpha == image::Alpha::straight ? "straight" : "premultiplied");
    if (plan_.exposure.several())
        format.metadata.emplace_back("Samples", std::to_string(plan_.exposure.samples));
    if (plan_.exposure.shutter > 0)
        format.metadata.emplace_back("Shutter", fmt::format("{}", plan_.exposure.shutter));
    if (!plan_.request.defines.empty())
        format.metadata.emplace_back("Defines", fmt::format("{}", fmt::join(plan_.request.defines, "; ")));
    return format;
}

/// Returns the metadata that the sheet's moments share, and the list of moments.
image::PictureFormat Capture::format_of_sheet() const {
    image::PictureFormat format = format_of(records_.first());
    constexpr std::string_view k_of_one[] = {k_fingerprint, k_moment, "Frame", "iTime", "iMouse", "Camera"};
    std::erase_if(format.metadata, [&](const auto& fact) {
        return std::ranges::find(k_of_one, fact.first) != std::end(k_of_one);
    });
    std::vector<int> frames;
    std::vector<double> times;
    for (const FrameRecord& record : records_.list()) {
        frames.push_back(record.frame);
        times.push_back(states_(record.frame).seconds());
    }
    format.metadata.emplace_back("Sheet", fmt::format("{}x{}", plan_.sheet->columns, plan_.sheet->rows));
    format.metadata.emplace_back("Frames", fmt::format("{}", fmt::join(frames, ",")));
    format.metadata.emplace_back("Times", fmt::format("{}", fmt::join(times, ",")));
    return format;
}

nlohmann::ordered_json Capture::report() const {
    nlohmann::ordered_json report;
    report["tidemark"] = k_version;
    report["scene"] = renderer_.scene().file.string();
    report["size"] = {renderer_.extent().width, renderer_.extent().height};
    if (const auto tiles = renderer_.tiles()) {
        const Extent size = tiles->tile();
        report["tiles"] = {{"size", {size.width, size.height}}, {"count", tiles->count()}};
    }
    report["driver"] = driver_.version;
    report["renderer"] = driver_.renderer;
    report["pass"] = renderer_.shown_pass().name;
    add_precision(report, renderer_);
    report["knobs"] = knobs_of(renderer_.scene());
    report["defines"] = plan_.request.defines;
    report["prepare_milliseconds"] = prepare_milliseconds_;
    report["left_out"] = facts_of(renderer_).left_out;
    if (plan_.sheet)
        report["sheet"] = {plan_.sheet->columns, plan_.sheet->rows};
    if (plan_.layers)
        report["layers"] = layer_names(renderer_);
    if (plan_.resume)
        report["kept"] = plan_.kept;
    if (plan_.loop)
        report["loop"] = {{"closing_psnr", loop_.closing()}, {"step_psnr", loop_.step()}};
    report["frames"] = nlohmann::ordered_json::array();
    for (const FrameRecord& record : records_.list()) {
        const render::FrameState state = states_(record.frame);
        const glm::vec4 mouse = state.mouse.uniform();
        auto& frame = report["frames"].emplace_back(
            nlohmann::ordered_json{{"frame", record.frame},
                                   {"iTime", state.seconds()},
                                   {"iMouse", {mouse.x, mouse.y, mouse.z, mouse.w}},
                                   {"camera", to_string(state.camera)},
                                   {"file", record.file},
                                   {"sha256", record.sha256},
                                   {"not_finite", record.not_finite},
                                   {"passes_drawn", record.passes_drawn},
                                   {"milliseconds", record.milliseconds}});
        if (keeps_alpha())
            frame["no_coverage"] = record.no_coverage;
    }
    return report;
}

} // namespace tidemark::cli
