#include "cli/view/viewer.hpp"

#include "base/file.hpp"
#include "cli/console.hpp"
#include "cli/picture_facts.hpp"
#include "cli/view/wall_clock.hpp"
#include "gl/render_target.hpp"
#include "image/files/picture_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <variant>

namespace tidemark::cli {
namespace {

using platform::Key;

constexpr const char* k_help = R"(drag        iMouse; turns the camera of a scene that declares iCamera
wheel       zooms that camera     middle drag  pans it     R  resets it
space       pause                 left, right  a frame back, forward
Home        restart               S            save a picture
F           full screen           Esc          quit; while it compiles: give up      H  this help
A scene that reads the keyboard gets all keys but Esc: hold Ctrl for the above.)";

/// So long compiling goes unmentioned.
constexpr double k_short_wait_seconds = 0.3;
/// Seconds on show are no older than this.
constexpr double k_title_seconds = 0.25;

/// The first thing that is wrong, in one line.
std::string headline(const Error& error) {
    for (const Diagnostic& diagnostic : error.diagnostics)
        if (diagnostic.severity == Severity::error)
            return to_string(diagnostic);
    return error.message;
}

render::RenderOptions options_for(const platform::Window& window, const Viewer::Settings& settings) {
    return {window.framebuffer_extent(), image::SampleType::u8, settings.pass, precision_of(settings.scene)};
}

} // namespace

Viewer::Viewer(Settings settings, platform::Window window, LiveScene scene)
    : settings_(std::move(settings)), window_(std::move(window)), scene_(std::move(scene)),
      sound_(std::make_unique<SoundPlayer>()), clock_(clock_from(now_seconds())),
      controls_(settings_.frames.camera) {
    // Somebody who records sees the recording: there is nothing that it could show otherwise.
    if (settings_.frames.input || recording())
        replay_.emplace(settings_.frames.input.value_or(InputScript{}), settings_.frames.camera);
}

/// Of frames where they are recorded or replayed: a wall clock never shows the same twice.
render::LiveClock Viewer::clock_from(double now) const {
    const bool by_frames = settings_.frames.input || recording();
    return render::LiveClock(now, by_frames ? std::optional(settings_.frames.fps) : std::nullopt);
}

Result<Viewer> Viewer::open(Settings settings) {
    auto scene = load(settings.scene);
    if (!scene)
        return fail(std::move(scene.error()));
    auto window = platform::Window::create(settings.frames.extent, scene->name() + " - tidemark");
    if (!window)
        return fail(std::move(window.error()));
    auto live = LiveScene::create(settings.scene, *std::move(scene), *window,
                                  {options_for(*window, settings), {}, settings.rehearsal});
    if (!live)
        return fail(std::move(live.error()));
    return Viewer(std::move(settings), *std::move(window), *std::move(live));
}

Result<int> Viewer::run(const Interrupt& interrupt) {
    while (!closing_ && !interrupt.requested()) {
        for (const platform::InputEvent& event : window_.wait(seconds_to_sleep(now_seconds())))
            std::visit([this](const auto& happened) { handle(happened); }, event);
        const double now = now_seconds();
        if (auto followed = follow_scene(now); !followed)
            return fail(std::move(followed.error()));
        settle_after_rest(now);
        if (wants_frame(now))
            draw(now);
        show_title(now);
        sound_->follow(clock_.time(now), !clock_.paused());
    }
    return finish().map([&] { return interrupt.requested() ? Interrupt::k_exit_code : 0; });
}

Result<void> Viewer::finish() {
    if (recording())
        if (auto written = write_file(settings_.record, to_string(replay_->script())); !written)
            return written;
    return writer_ ? writer_->finish() : Result<void>();
}

bool Viewer::wants_frame(double now) const {
    const Extent extent = window_.framebuffer_extent();
    if (extent.width == 0 || extent.height == 0)
        return false; // minimised
    return stale_ || (moving() && now >= next_draw_);
}

/// Frames follow each other by themselves.
bool Viewer::moving() const {
    return stage_ && !clock_.paused() && !at_rest_;
}

double Viewer::seconds_to_sleep(double now) const {
    double until = std::numeric_limits<double>::infinity();
    if (stale_)
        return 0;
    if (moving())
        until = next_draw_;
    if (scene_.building_since())
        until = std::min(until, now + k_title_seconds);
    if (const auto wake = scene_.wake_at())
        until = std::min(until, *wake);
    return std::max(0.0, until - now);
}

void Viewer::draw(double now) {
    const bool stale = std::exchange(stale_, false);
    if (!stage_) {
        gl::clear_window();
        return window_.swap();
    }
    render::Renderer& renderer = stage_->renderer();
    next_draw_ = std::max(next_draw_ + 1 / settings_.frames.fps, now);
    shown_ = clock_.next_frame(now);
    shown_.date = settings_.date ? *settings_.date : render::local_date();
    if (replay_)
        replay_->fill(shown_, renderer.extent().height);
    else
        controls_.fill(shown_);
    const size_t drawn_before = renderer.passes_drawn();
    renderer.draw(shown_);
    const bool drawn = renderer.passes_drawn() != drawn_before;
    if (drawn || stale) {
        gl::blit_to_window(renderer.target(), window_.framebuffer_extent());
        window_.swap();
    }
    controls_.frame_drawn();
    // Frames are counted on where somebody writes their numbers down, or reads them.
    at_rest_ = !drawn && !renderer.follows_clock() && !replay_;
    if (at_rest_)
        clock_.rest();
    if (reloaded_)
        report_reload();
}

bool Viewer::compiles_for_long(double now) const {
    const auto since = scene_.building_since();
    return since && now - *since > k_short_wait_seconds;
}

/// What is being waited for, else the error while there is one, else the frame rate, which changes twice a
/// second at most.
void Viewer::show_title(double now) {
    std::string state = clock_.paused() ? fmt::format("paused at {:.3f} s", shown_.time)
                        : at_rest_      ? "still"
                                        : fmt::format("{:.0f} fps", clock_.frame_rate());
    if (compiles_for_long(now))
        state = fmt::format("compiling… {:.0f} s{}", now - *scene_.building_since(),
                            stage_ ? ", Esc gives up" : "");
    else if (!stage_)
        return;
    std::string title = scene_.failure() && !compiles_for_long(now)
                            ? headline(*scene_.failure())
                            : fmt::format("{} - tidemark - {}", scene_.name(), state);
    if (title == title_)
        return;
    title_ = std::move(title);
    window_.set_title(title_);
}

/// Uniforms follow the mouse and the keys; a paused picture is drawn anew when they do.
void Viewer::control(const ControlEvent& event) {
    if (!controls_.handle(event, window_.framebuffer_extent().height))
        return;
    touched_at_ = now_seconds();
    stale_ = true;
    if (recording())
        replay_->note(clock_.next_frame_number(), event);
}

/// A key is the scene's or ours, and goes as it came. Ctrl is the scene's: what follows it is ours.
void Viewer::handle(const platform::KeyPressed& event) {
    const bool is_control = event.key == Key::control;
    const bool ours = (control_down_ && !is_control) || event.key == Key::escape || !scene_reads_keyboard();
    control_down_ |= is_control;
    const bool repeats = event.key == Key::left || event.key == Key::right;
    if (!event.repeat && ours)
        obeyed_.insert(event.key);
    if (obeyed_.contains(event.key) && (!event.repeat || repeats))
        obey(event.key, now_seconds());
    else if (!event.repeat && !ours)
        control(event);
}

void Viewer::handle(const platform::KeyReleased& event) {
    if (event.key == Key::control)
        control_down_ = false;
    if (obeyed_.erase(event.key) == 0)
        control(event);
}

/// Such a scene has the keys to itself; with Ctrl they are the viewer's again.
bool Viewer::scene_reads_keyboard() const {
    if (!stage_)
        return false;
    for (const render::PlannedPass& planned : stage_->renderer().plan().passes) {
        if (planned.keyboard_helpers)
            return true;
        for (const int channel : planned.channels)
            if (std::holds_alternative<scene::Keyboard>(
                    stage_->renderer().scene().passes[planned.pass].channels[size_t(channel)].input))
                return true;
    }
    return false;
}

void Viewer::obey(Key key, double now) {
    switch (key) {
    case Key::left:
        clock_.step(-1, settings_.frames.fps, now);
        forget_what_follows();
        break;
    case Key::right: clock_.step(1, settings_.frames.fps, now); break;
    case Key::space: clock_.toggle_pause(now); break;
    case Key::home:
        if (stage_)
            stage_->renderer().reset();
        clock_.restart(now);
        forget_what_follows();
        break;
    case Key::r: return control(CameraReset{});
    case Key::f: window_.toggle_full_screen(); break;
    case Key::escape:
        if (stage_ && compiles_for_long(now))
            scene_.give_up();
        else
            closing_ = true;
        break;
    case Key::s: return save_picture(); // of the frame on show: nothing is drawn anew
    case Key::h: return say(k_help);
    default: return;
    }
    stale_ = true;
}

/// Time went backwards: the recording ends at the frame that is next.
void Viewer::forget_what_follows() {
    if (recording())
        replay_->go_back(clock_.next_frame_number());
}

void Viewer::handle(const platform::FramebufferResized& event) {
    if (event.extent.width == 0 || event.extent.height == 0)
        return;
    if (stage_)
        if (auto resized = stage_->renderer().resize(event.extent); !resized)
            say(to_string(resized.error())); // the old picture is stretched
    touched_at_ = now_seconds();
    stale_ = true;
}

void Viewer::save_picture() {
    if (!stage_)
        return;
    if (!writer_)
        writer_ = std::make_unique<FrameWriter>(1U);
    const std::string name = fmt::format("{}-{:05}.png", scene_.name(), shown_.frame);
    const FrameFacts facts{shown_.frame, shown_.time, shown_.mouse,
                           replay_ ? replay_->camera() : controls_.camera()};
    const image::PictureFormat format{image::SampleDepth::u8, metadata_of(stage_->renderer().scene(), facts)};
    if (writer_->push({shown_.frame, name, stage_->renderer().read_back(), format}))
        say(fmt::format("saving {}", name));
    else if (auto written = std::exchange(writer_, nullptr)->finish(); !written)
        say(to_string(written.error()));
}

LiveScene::View Viewer::view() const {
    return {options_for(window_, settings_), shown_, settings_.rehearsal};
}

Result<void> Viewer::follow_scene(double now) {
    const bool failed = scene_.failure() != nullptr;
    auto fresh = scene_.follow(window_, view(), now);
    if (!fresh)
        return fail(std::move(fresh.error()));
    stale_ = stale_ || failed != (scene_.failure() != nullptr);
    return *fresh ? show(**std::move(fresh), now) : Result<void>();
}

/// From now on. One that has settled draws what was drawn before: nothing else changes.
Result<void> Viewer::show(Stage fresh, double now) {
    if (!stage_)
        clock_ = clock_from(now);
    if (auto swapped = swap_in(std::move(fresh)); !swapped)
        return swapped;
    if (stage_->share()) {
        say(fmt::format("specialised: a frame takes {:.2f} of its time", *stage_->share()));
        return {};
    }
    play_sound();
    reloaded_ = scene_.take_times();
    settled_ = false;
    stale_ = true;
    touched_at_ = now;
    return {};
}

/// What was on show before goes, its buffers' content stays: as on the site, a text that is changed goes on
/// from where it was.
Result<void> Viewer::swap_in(Stage fresh) {
    if (stage_)
        glFinish(); // what it drew is there to be taken over
    const std::optional<Stage> before = std::exchange(stage_, std::nullopt);
    stage_.emplace(std::move(fresh));
    if (auto entered = stage_->enter(); !entered)
        return entered;
    if (before)
        stage_->renderer().continue_from(before->renderer());
    if (const Extent extent = window_.framebuffer_extent(); extent != stage_->renderer().extent())
        handle(platform::FramebufferResized{extent}); // it has changed meanwhile
    return {};
}

/// Only what moves: a picture that stands still is not drawn anyway.
void Viewer::settle_after_rest(double now) {
    if (settings_.plain || settled_ || !moving() || scene_.building_since() || scene_.failure())
        return;
    const auto rest = stage_->seconds_to_settle();
    if (!rest || now - touched_at_ < *rest)
        return;
    settled_ = true;
    scene_.settle(stage_->renderer().scene(), window_, view());
}

void Viewer::play_sound() {
    const scene::Scene& scene = stage_->renderer().scene();
    if (!scene.find(scene::PassKind::sound))
        return sound_->stop();
    if (auto context = window_.create_context())
        sound_->play(*std::move(context), scene, precision_of(settings_.scene));
    else
        say(to_string(context.error()));
}

/// Our share (noticing, loading) and the driver's (compiling, drawing for the first time) side by side. The
/// file's time is as coarse as the kernel's tick.
void Viewer::report_reload() {
    glFinish(); // the picture is on show when the drawing is done
    const double shown = now_seconds();
    const auto ms = [](double seconds) { return seconds * 1000; };
    const double total =
        std::chrono::duration<double>(std::filesystem::file_time_type::clock::now() - reloaded_->saved)
            .count();
    say(fmt::format("reloaded in {:.0f} ms: notice {:.0f}, load {:.1f}, compile {:.0f}, first draw {:.0f}",
                    ms(total), ms(total - (shown - reloaded_->seen)), ms(reloaded_->loaded - reloaded_->seen),
                    ms(reloaded_->compiled - reloaded_->loaded), ms(shown - reloaded_->compiled)));
    reloaded_.reset();
}

} // namespace tidemark::cli
