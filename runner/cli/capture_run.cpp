#include "cli/capture_run.hpp"

#include "base/error.hpp"
#include "base/supervision.hpp"
#include "host/console.hpp"
#include "host/program_trial.hpp"
#include "host/scene_report.hpp"
#include "lab/instrumented_pass.hpp"
#include "media/comparison.hpp"
#include "media/image.hpp"
#include "render/exposure.hpp"
#include "render/gl_context.hpp"
#include "render/picture_parts.hpp"

#include <fmt/format.h>
#include <malloc.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace tidemark::cli {

using namespace host;
namespace {

/// One frame is drawn while the previous one is copied and the one before that is encoded.
constexpr size_t k_depth = 2;

/// Returns the pictures in one, from the top down.
image::Image stacked(std::span<const image::Image> pictures) {
    const image::Image& one = pictures.front();
    image::Image all({one.extent.width, int(pictures.size()) * one.extent.height}, one.channels, one.type,
                     {});
    for (auto picture = pictures.rbegin(); picture != pictures.rend(); ++picture)
        all.bytes.insert(all.bytes.end(), picture->bytes.begin(), picture->bytes.end());
    return all;
}

/// The change of a PSNR when differences are halved.
constexpr double k_half_in_decibels = 6.0;

/// Freed blocks up to this size stay in the process: a 4K frame of bytes.
constexpr int k_kept_bytes = 32 << 20;

double milliseconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// Returns the frame that would come next.
int frame_behind(const std::vector<int>& frames) {
    const int last = frames.back();
    return frames.size() > 1 ? 2 * last - frames[frames.size() - 2] : last + 1;
}

/// Returns the size of the tiles; nothing if frames are drawn whole.
Result<std::optional<Extent>> choose_tile(const CapturePlan& plan) {
    const int limit = gl::query_capabilities().largest_target;
    if (plan.options.drawing.tile)
        return render::tile_of_side(*plan.options.drawing.tile, limit).map([](Extent tile) {
            return std::optional(tile);
        });
    const bool whole = plan.output.video() || plan.encoding.layers || plan.area.sheet || plan.drawing.lens;
    const auto tile = whole ? std::nullopt
                            : render::tile_for(plan.drawing.options.extent,
                                               4 * image::size_of(plan.drawing.options.samples), limit);
    return plan.drawing.exposure.several() && !tile ? plan.drawing.options.extent
                                                    : tile; // one tile, shifted for each sample
}

/// Rejects options that the compiled scene does not allow.
Result<void> check_compiled(const CapturePlan& plan, const render::Renderer& renderer) {
    const auto refuse = [](std::string why) { return fail(ErrorCode::usage, std::move(why)); };
    if (plan.options.drawing.tile && !renderer.tiles())
        return refuse(fmt::format(
            "--tile: {} cannot be drawn in tiles: it is a cube, another pass reads it, or it discards pixels",
            renderer.shown_pass().name));
    if (plan.options.run.loop && renderer.tiles() && renderer.tiles()->count() > 1)
        return refuse("--loop: frames drawn in tiles cannot be compared; give a smaller --size");
    if (plan.drawing.exposure.several() && renderer.shown_pass().kind != scene::PassKind::image)
        return refuse("--samples: only frames of Image can be averaged");
    if (plan.drawing.exposure.several() && !renderer.tiles())
        return refuse("--samples: Image cannot be drawn several times per frame: a pass reads it, or it "
                      "discards pixels");
    if (plan.drawing.exposure.shutter > 0 && renderer.plan().feedback)
        return refuse("--shutter: this scene reads its own last frame, so there are no moments between two "
                      "frames; --samples alone smooths its edges");
    return {};
}

/// Returns the faster of two programs if a trial is planned. No trial in tiles: the picture is too
/// large to draw it for one.
Result<Trial> choose_renderer(const CapturePlan& plan, render::RenderOptions drawing) {
    if (!plan.drawing.trial || drawing.tile)
        return Trial{TRY(render::Renderer::create(plan.scene, drawing))};
    drawing.specialise =
        plan.drawing.trial->allowed ? glsl::Specialise::constants : glsl::Specialise::invariant_uniforms;
    auto trial = TRY(choose_program(plan.scene, drawing, *plan.drawing.trial));
    if (!trial.said.empty())
        say(trial.said);
    return trial;
}

Result<Trial> compile_all(const CapturePlan& plan, Interrupt& interrupt) {
    const Interrupt::Immediate at_once(interrupt);
    Watchdog watchdog;
    const Watchdog::Watch watch(watchdog, {"compiling", plan.options.run.timeout});
    const auto tile = TRY(choose_tile(plan));
    render::RenderOptions drawing = plan.drawing.options;
    drawing.tile = tile;
    auto compiled = TRY(choose_renderer(plan, drawing));
    TRY(check_compiled(plan, compiled.renderer));
    return compiled;
}

} // namespace

Result<Trial> compile(const CapturePlan& plan, Interrupt& interrupt) {
    if (!plan.frames.frames.empty())
        Doing::note_frame(DoingPage::Frame{plan.frames.frames.front(), false});
    return compile_all(plan, interrupt).map_error([&](Error error) {
        if (error.code == ErrorCode::no_memory && !plan.frames.frames.empty())
            error.message += fmt::format(" (before frame {})", plan.frames.frames.front());
        return error;
    });
}

/// A driver that draws on the CPU copies pixels itself and waits for the drawing before: nothing more
/// overlaps, and there is one copy more (figures: tests/bench/README.md).
bool FramesAhead::pays(std::string_view renderer) {
    const char* const variable = std::getenv("TIDEMARK_READ_BACK");
    const std::string_view wish = variable ? variable : "";
    return wish == "ahead" || (wish != "at-once" && !gl::is_software_renderer(renderer));
}

FramesAhead::FramesAhead(const render::Renderer& renderer, Watchdog& dog, std::optional<double> limit)
    : renderer_(renderer), dog_(dog), limit_(limit), ring_(k_depth) {}

bool FramesAhead::add(const FrameRecord& record, Watchdog::Clock::time_point begun) {
    if (!renderer_.read_ahead(ring_))
        return false;
    waiting_.push_back({record, begun});
    return true;
}

DrawnFrame FramesAhead::take() {
    Waiting oldest = std::move(waiting_.front());
    waiting_.pop_front();
    std::optional<Watchdog::Watch> watch;
    if (!ring_.ready())
        watch.emplace(dog_,
                      Watchdog::frame_task(oldest.record.frame, limit_, std::max(oldest.begun, last_taken_)));
    DrawnFrame frame{std::move(oldest.record), renderer_.take(ring_)};
    last_taken_ = Watchdog::Clock::now();
    return frame;
}

void LoopCheck::see(std::span<const image::Image> pictures) {
    if (pictures.size() == 1)
        see(pictures.front());
    else
        see(stacked(pictures));
}

void LoopCheck::see(const image::Image& picture) {
    if (closed_) {
        beyond_ = image::compare(first_, picture)->psnr;
        return;
    }
    before_ = std::exchange(last_, picture);
    if (++seen_ == 1)
        first_ = picture;
    if (seen_ == 2)
        step_ = image::compare(first_, picture)->psnr;
}

void LoopCheck::close() {
    closed_ = true;
    closing_ = image::compare(first_, last_)->psnr;
    end_ = image::compare(first_, before_)->psnr;
    step_ = std::min(step_, image::compare(before_, last_)->psnr);
}

/// Returns true if a frame differs from the first by less than half a step, or not at all.
bool LoopCheck::is_near(double psnr) const {
    return std::isinf(psnr) || psnr >= step_ + k_half_in_decibels;
}

bool LoopCheck::may_lack_a_frame() const {
    return !seamless() && closing_ >= step_ - k_half_in_decibels;
}

std::string LoopCheck::words(const std::vector<int>& frames) const {
    const std::string numbers =
        fmt::format("the frame after the last matches the first with {:.1f} dB (a step inside of the loop: "
                    "{:.1f} dB)",
                    closing_, step_);
    if (seamless())
        return "loop: seamless; " + numbers;
    if (is_near(end_))
        return fmt::format("loop: fails; frame {} repeats the first: leave it out; {}", frames.back(),
                           numbers);
    if (beyond_ && is_near(*beyond_))
        return fmt::format("loop: fails; frame {} is missing at the end; {}", frame_behind(frames), numbers);
    return "loop: fails; it jumps at the start; " + numbers;
}

std::string Capture::cut_loops_warning() {
    if (!gl::is_software_renderer(driver_.renderer) || !lab::may_exceed_safe_iterations(renderer_))
        return {};
    const auto limit = lab::loop_limit();
    if (!limit || !*limit)
        return {};
    const auto cut = lab::cut_loops(renderer_, inputs_of(plan_.states(plan_.frames.frames.back())), true);
    return cut && !cut->empty()
               ? "warning: " + lab::to_string(*cut, **limit) + ": the picture is incomplete here"
               : std::string();
}

Capture::Capture(const CapturePlan& plan, Trial& compiled, std::filesystem::path sound)
    : plan_(plan), renderer_(compiled.renderer), in_doubt_(compiled.in_doubt),
      driver_(gl::query_capabilities()), stepper_(renderer_, plan.states), saver_(plan, renderer_),
      delivery_(plan, renderer_, driver_, watchdog_, std::move(sound)),
      watchdog_([this] { rescue_output(); }) {}

Result<bool> Capture::run(Interrupt& interrupt) {
    // Reuses a frame's memory for the next frame, instead of returning it to the system, which would clear it
    // again.
    ::mallopt(M_MMAP_THRESHOLD, k_kept_bytes);
    ::mallopt(M_TRIM_THRESHOLD, 4 * k_kept_bytes); // including its copies on the way to a file
    TRY(delivery_.open(interrupt));
    if (draws_ahead())
        ahead_.emplace(renderer_, watchdog_, plan_.options.run.timeout);
    if (!plan_.frames.frames.empty()) {
        Doing::note_frame(DoingPage::Frame{plan_.frames.frames.front(), true});
        TRY(prepare(interrupt));
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
            TRY(delivery_.stop());
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
    const bool loop_known = !loop_.begun() || TRY(close_loop(interrupt));
    TRY(delivery_.close());
    if (plan_.shard && plan_.options.run.state_every > 0 && !plan_.frames.frames.empty() &&
        renderer_.plan().feedback)
        TRY(saver_.save_buffers(plan_.frames.frames.back() + 1)); // the next shard may start from it
    return loop_known;
}

/// Returns false with --json, which reports each frame's own time, and if more is read of a frame than the
/// shown picture, or in another way.
bool Capture::draws_ahead() const {
    const scene::PassKind shown = renderer_.shown_pass().kind;
    const bool whole_in_memory =
        !delivery_.in_bands() && !plan_.drawing.exposure.several() && shown != scene::PassKind::cubemap;
    const bool tells_non_finite =
        shown == scene::PassKind::image || renderer_.samples() == image::SampleType::f32;
    return plan_.frames.frames.size() > 1 && whole_in_memory && tells_non_finite && !plan_.encoding.layers &&
           !plan_.drawing.lens && !plan_.options.run.json && FramesAhead::pays(driver_.renderer);
}

/// Does the work that drivers defer until the first draw, so that it does not count for a frame's time or
/// limit.
Result<void> Capture::prepare(Interrupt& interrupt) {
    const Interrupt::Immediate at_once(interrupt);
    const Watchdog::Watch watch(watchdog_, {"preparing the first frame", plan_.options.run.timeout});
    const auto start = Clock::now();
    if (plan_.drawing.lens)
        lens_.emplace(TRY(LensDrawing::create(plan_, renderer_)));
    renderer_.warm_up(inputs_of(plan_.states(plan_.frames.frames.front())));
    prepare_milliseconds_ = milliseconds_since(start);
    return {};
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
        work.watch.emplace(watchdog_, Watchdog::frame_task(step, plan_.options.run.timeout, work.begun));
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
    if (!delivery_.drain())
        return false;
    TRY(saver_.save_buffers(frame));
    return true;
}

/// Returns the frame as it is to be written; nothing if interrupted.
Result<std::optional<WrittenFrame>> Capture::draw(int frame, const Interrupt& interrupt) {
    DrawnFrame drawn;
    std::optional<Work> work(std::in_place);
    if (!TRY(step_to(frame, interrupt, drawn.record, *work)))
        return std::nullopt;
    auto pixels = lens_ ? std::optional<DrawnPixels>(TRY(lens_->draw(frame, interrupt)))
                  : plan_.drawing.exposure.several() ? draw_samples(frame, interrupt)
                                                     : std::optional(read_back());
    if (lens_ && interrupt.requested())
        return std::nullopt;
    if (lens_ && plan_.options.run.json)
        lens_reports_.push_back(lens_->report(plan_.frames.frames.size() == 1));
    if (!pixels)
        return std::nullopt;
    TRY(check_driver(fmt::format("drawing frame {}", frame)));
    drawn.pixels = *std::move(pixels);
    drawn.record.milliseconds = milliseconds_since(work->start);
    work.reset();
    return finish(std::move(drawn));
}

/// Checks the driver before pixels are used. On failure, earlier frames are written first.
Result<void> Capture::check_driver(const std::string& doing) {
    return gl::check_work(doing).map_error([&](Error error) {
        delivery_.drain();
        error.message += "; try a smaller --size or --tile";
        return error;
    });
}

/// Converts a frame to what is written of it, and shows that to the check of the loop.
WrittenFrame Capture::finish(DrawnFrame drawn) {
    WrittenFrame frame = delivery_.prepare(std::move(drawn));
    if (plan_.options.run.loop)
        loop_.see(frame.pictures);
    return frame;
}

/// Draws the frame after the last one for the comparison, and one more if the sequence may lack a frame; they
/// are not written. Returns false if interrupted.
Result<bool> Capture::close_loop(const Interrupt& interrupt) {
    std::vector<int> frames = plan_.frames.frames;
    frames.push_back(frame_behind(frames));
    if (!TRY(draw(frames.back(), interrupt)))
        return false;
    loop_.close();
    const int beyond = frame_behind(frames);
    if (!loop_.may_lack_a_frame() || beyond < 0 || beyond > render::k_last_frame)
        return true;
    return TRY(draw(beyond, interrupt)).has_value();
}

Result<Capture::Outcome> Capture::make(int frame, const Interrupt& interrupt) {
    if (delivery_.in_bands())
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
    return hand_over(finish(std::move(drawn)));
}

Result<Capture::Outcome> Capture::hand_over_all_ahead() {
    auto outcome = Outcome::made;
    while (ahead_ && !ahead_->empty() && outcome == Outcome::made)
        outcome = TRY(hand_over_ahead(ahead_->take()));
    return outcome;
}

Result<Capture::Outcome> Capture::hand_over(WrittenFrame frame) {
    return TRY(delivery_.deliver(std::move(frame))) ? Outcome::made : Outcome::unwanted;
}

/// Draws a frame in tiles. The time limit applies to the frame, the watchdog's messages to a tile.
Result<Capture::Outcome> Capture::make_in_tiles(int frame, const Interrupt& interrupt) {
    FrameRecord record;
    Work work;
    if (!TRY(step_to(frame, interrupt, record, work)))
        return Outcome::interrupted;
    work.watch.reset();
    auto output = TRY(delivery_.open_bands(frame));
    BandOutput& bands = *output;
    const render::ExposedFrame exposed = expose(plan_.drawing.exposure, plan_.states(frame));
    Progress progress("tiles", renderer_.tiles()->count() * exposed.samples.size());
    const auto before_tile = [&] {
        if (work.watch)
            progress.advance();
        work.watch.reset();
        work.watch.emplace(watchdog_, Watchdog::frame_task(frame, plan_.options.run.timeout, work.start));
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
    delivery_.add(std::move(record), bands);
    return Outcome::made;
}

/// Reads the picture or the cube that was just drawn.
DrawnPixels Capture::read_back() const {
    if (renderer_.shown_pass().kind == scene::PassKind::cubemap)
        return renderer_.read_back_cube();
    return renderer_.read_back();
}

/// Returns nothing if interrupted.
std::optional<DrawnPixels> Capture::draw_samples(int frame, const Interrupt& interrupt) {
    const render::ExposedFrame exposed = expose(plan_.drawing.exposure, plan_.states(frame));
    Progress progress("samples", exposed.samples.size());
    return draw_in_tiles(renderer_, exposed, [&] {
        progress.advance();
        return !interrupt.requested();
    });
}

size_t Capture::whole_frames() {
    return plan_.kept.size() + delivery_.written();
}

/// Saves the frames that were drawn. Runs on the watchdog's thread while the main thread is stuck in the
/// driver.
void Capture::rescue_output() {
    delivery_.rescue();
    if (const std::string words = words_on_resuming(plan_, whole_frames()); !words.empty())
        say(words);
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
    report["defines"] = plan_.options.scene.defines;
    report["prepare_milliseconds"] = prepare_milliseconds_;
    report["left_out"] = facts_of(renderer_).left_out;
    if (plan_.area.crop) {
        const auto& [x, y, size] = *plan_.area.crop;
        report["crop"] = {x, y, size.width, size.height};
    }
    if (plan_.area.sheet)
        report["sheet"] = {plan_.area.sheet->columns, plan_.area.sheet->rows};
    if (plan_.encoding.layers)
        report["layers"] = layer_names(renderer_);
    if (plan_.options.run.resume)
        report["kept"] = plan_.kept;
    if (loop_.closed())
        report["loop"] = {
            {"seamless", loop_.seamless()}, {"closing_psnr", loop_.closing()}, {"step_psnr", loop_.step()}};
    report["frames"] = nlohmann::ordered_json::array();
    for (const FrameRecord& record : records().list()) {
        const render::FrameState state = plan_.states(record.frame);
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
        if (plan_.keeps_alpha())
            frame["no_coverage"] = record.no_coverage;
        if (const size_t index = report["frames"].size() - 1; index < lens_reports_.size())
            frame["lens"] = lens_reports_[index];
    }
    return report;
}

} // namespace tidemark::cli
