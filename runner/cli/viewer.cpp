#include "cli/viewer.hpp"

#include "base/file.hpp"
#include "cli/console.hpp"
#include "cli/version.hpp"
#include "gl/render_target.hpp"
#include "image/picture_file.hpp"

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
F           full screen           Esc          quit        H  this help
A scene that reads the keyboard gets all keys but Esc: hold Ctrl for the above.)";

/// How long a scene that does not load may still be in the middle of being saved. An editor's pause between
/// two writes is shorter, a person's patience longer.
constexpr double k_half_written_seconds = 0.06;

double now_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The first thing that is wrong, in one line.
std::string headline(const Error& error) {
    for (const Diagnostic& diagnostic : error.diagnostics)
        if (diagnostic.severity == Severity::error)
            return to_string(diagnostic);
    return error.message;
}

} // namespace

Viewer::Viewer(Settings settings, platform::Window window, platform::FileWatcher watcher,
               render::Renderer renderer)
    : settings_(std::move(settings)), window_(std::move(window)), watcher_(std::move(watcher)),
      renderer_(std::move(renderer)), clock_(now_seconds()), controls_(settings_.frames.camera) {
    if (settings_.frames.input)
        replay_.emplace(*settings_.frames.input, settings_.frames.camera);
}

Result<Viewer> Viewer::open(Settings settings) {
    auto scene = load(settings.scene);
    if (!scene)
        return fail(std::move(scene.error()));
    auto window = platform::Window::create(settings.frames.extent, scene->name() + " - tidemark");
    if (!window)
        return fail(std::move(window.error()));
    // After the window, so that it ends before it: its thread wakes the window.
    auto watcher = platform::FileWatcher::create([] { platform::Window::wake(); });
    if (!watcher)
        return fail(std::move(watcher.error()));
    if (auto watched = watcher->watch(scene->files); !watched)
        say(to_string(watched.error())); // it can still be looked at
    auto renderer = render::Renderer::create(
        *std::move(scene), {window->framebuffer_extent(), image::SampleType::u8, settings.pass});
    if (!renderer)
        return fail(std::move(renderer.error()));
    return Viewer(std::move(settings), *std::move(window), *std::move(watcher), *std::move(renderer));
}

Result<int> Viewer::run() {
    while (!closing_) {
        for (const platform::InputEvent& event : window_.wait(seconds_to_sleep(now_seconds()))) {
            let_the_scene_know(event);
            std::visit([this](const auto& happened) { handle(happened); }, event);
        }
        follow_files();
        const double now = now_seconds();
        if (report_at_ && now >= *report_at_)
            report_failure();
        if (wants_frame(now))
            draw(now);
    }
    return finish();
}

Result<int> Viewer::finish() {
    if (!settings_.record.empty())
        if (auto written = write_file(settings_.record, to_string(recorded_)); !written)
            return fail(std::move(written.error()));
    return writer_ ? writer_->finish().map([] { return 0; }) : Result<int>(0);
}

bool Viewer::wants_frame(double now) const {
    const Extent extent = window_.framebuffer_extent();
    if (extent.width == 0 || extent.height == 0)
        return false; // minimised
    return stale_ || (!clock_.paused() && now >= next_draw_);
}

double Viewer::seconds_to_sleep(double now) const {
    double until = std::numeric_limits<double>::infinity();
    if (stale_)
        return 0;
    if (!clock_.paused())
        until = next_draw_;
    if (report_at_)
        until = std::min(until, *report_at_);
    return std::max(0.0, until - now);
}

void Viewer::draw(double now) {
    next_draw_ = std::max(next_draw_ + 1 / settings_.frames.fps, now);
    shown_ = clock_.next_frame(now);
    shown_.date = settings_.date ? *settings_.date : render::local_date();
    if (replay_)
        replay_->fill(shown_, renderer_.extent().height);
    else
        controls_.fill(shown_);
    renderer_.draw(shown_);
    gl::blit_to_window(renderer_.target(), window_.framebuffer_extent());
    window_.swap();
    controls_.frame_drawn();
    stale_ = false;
    if (reloaded_)
        report_reload();
    show_title();
}

/// The error while there is one, else the frame rate, which changes twice a second at most.
void Viewer::show_title() {
    const std::string state = clock_.paused() ? fmt::format("paused at {:.3f} s", shown_.time)
                                              : fmt::format("{:.0f} fps", clock_.frame_rate());
    std::string title = failure_ && !report_at_
                            ? headline(*failure_)
                            : fmt::format("{} - tidemark - {}", renderer_.scene().name(), state);
    if (title == title_)
        return;
    title_ = std::move(title);
    window_.set_title(title_);
}

/// Uniforms follow the mouse and the keys; a paused picture is drawn anew when they do.
void Viewer::let_the_scene_know(const platform::InputEvent& event) {
    const bool key = std::holds_alternative<platform::KeyPressed>(event) ||
                     std::holds_alternative<platform::KeyReleased>(event);
    if (!controls_.handle(event, renderer_.extent().height))
        return;
    stale_ = stale_ || !key || scene_reads_keyboard();
    if (!settings_.record.empty())
        record(recorded_, clock_.next_frame_number(), event);
}

void Viewer::handle(const platform::KeyPressed& event) {
    if (event.key == Key::control)
        control_down_ = true;
    const bool ours = control_down_ || event.key == Key::escape || !scene_reads_keyboard();
    const bool repeats = event.key == Key::left || event.key == Key::right;
    if (ours && (!event.repeat || repeats))
        obey(event.key, now_seconds());
}

void Viewer::handle(const platform::KeyReleased& event) {
    if (event.key == Key::control)
        control_down_ = false;
}

/// Such a scene has the keys to itself; with Ctrl they are the viewer's again.
bool Viewer::scene_reads_keyboard() const {
    for (const render::PlannedPass& planned : renderer_.plan().passes) {
        if (planned.keyboard_helpers)
            return true;
        for (const int channel : planned.channels)
            if (std::holds_alternative<scene::Keyboard>(
                    renderer_.scene().passes[planned.pass].channels[size_t(channel)].input))
                return true;
    }
    return false;
}

void Viewer::obey(Key key, double now) {
    switch (key) {
    case Key::left: clock_.step(-1, settings_.frames.fps, now); break;
    case Key::right: clock_.step(1, settings_.frames.fps, now); break;
    case Key::space: clock_.toggle_pause(now); break;
    case Key::home:
        renderer_.reset();
        clock_.restart(now);
        break;
    case Key::r: controls_.reset_camera(); break;
    case Key::f: window_.toggle_full_screen(); break;
    case Key::escape: closing_ = true; break;
    case Key::s: return save_picture(); // of the frame on show: nothing is drawn anew
    case Key::h: return say(k_help);
    default: return;
    }
    stale_ = true;
}

void Viewer::handle(const platform::FramebufferResized& event) {
    if (event.extent.width == 0 || event.extent.height == 0)
        return;
    if (auto resized = renderer_.resize(event.extent); !resized)
        say(to_string(resized.error())); // the old picture is stretched
    stale_ = true;
}

void Viewer::save_picture() {
    if (!writer_)
        writer_ = std::make_unique<FrameWriter>(1U);
    const std::string name = fmt::format("{}-{:05}.png", renderer_.scene().name(), shown_.frame);
    const image::PictureFormat format{image::SampleDepth::u8,
                                      {{"Scene", settings_.scene.path.string()},
                                       {"Frame", fmt::format("{}", shown_.frame)},
                                       {"iTime", fmt::format("{}", shown_.time)},
                                       {"Software", fmt::format("tidemark {}", k_version)}}};
    if (writer_->push({shown_.frame, name, renderer_.read_back(), format}))
        say(fmt::format("saving {}", name));
    else if (auto written = std::exchange(writer_, nullptr)->finish(); !written)
        say(to_string(written.error()));
}

void Viewer::follow_files() {
    const auto changed = watcher_.changed();
    if (changed.empty())
        return;
    auto reloaded = reload();
    stale_ = true;
    if (!reloaded) {
        failure_ = std::move(reloaded.error());
        report_at_ = now_seconds() + k_half_written_seconds;
        return;
    }
    if (failure_ && !report_at_)
        say(fmt::format("{}: good again", settings_.scene.path.string()));
    failure_.reset();
    report_at_.reset();
    reloaded_ = *reloaded;
    std::error_code ignored;
    reloaded_->saved = std::filesystem::last_write_time(changed.front(), ignored);
}

void Viewer::report_failure() {
    report_at_.reset();
    say(to_string(*failure_));
    stale_ = true;
}

Result<Viewer::ReloadTimes> Viewer::reload() {
    ReloadTimes times;
    times.seen = now_seconds();
    SceneRequest request = settings_.scene;
    request.sets.clear(); // they are among the knobs that were turned
    request.said = renderer_.scene().warnings;
    auto scene = load(request);
    if (!scene) {
        // What is missing or wrong may be a file that the last good scene did not have.
        std::vector<std::filesystem::path> files = renderer_.scene().files;
        files.insert(files.end(), scene.error().files.begin(), scene.error().files.end());
        (void)watcher_.watch(files); // a folder that is missing too cannot be watched: the rest is
        return fail(std::move(scene.error()));
    }
    keep_turned_knobs(*scene);
    // Before the slow part, so that a save during it is seen; and even if it fails, so that what it waits
    // for is seen.
    if (auto watched = watcher_.watch(scene->files); !watched)
        return fail(std::move(watched.error()));
    times.loaded = now_seconds();
    auto fresh = render::Renderer::create(*std::move(scene),
                                          {renderer_.extent(), image::SampleType::u8, settings_.pass});
    if (!fresh)
        return fail(std::move(fresh.error()));
    renderer_ = *std::move(fresh);
    times.compiled = now_seconds();
    return times;
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

void Viewer::keep_turned_knobs(scene::Scene& fresh) const {
    for (const scene::Knob& old : renderer_.scene().knobs)
        for (scene::Knob& knob : fresh.knobs)
            if (knob.name == old.name && knob.type == old.type && old.value != old.initial)
                knob.value = old.value;
}

} // namespace tidemark::cli
