#include "window/window_screen.hpp"

#include "base/dynamic_library.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/process.hpp"
#include "host/console.hpp"
#include "render/gl_textures.hpp"
#include "window/window.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <thread>
#include <utility>
#include <variant>

namespace tidemark::overlay {

using namespace host;
namespace {

/// Frames until the layout is final: sizes and hit tests lag one or two frames after a change.
constexpr int k_frames_to_settle = 3;

Result<std::unique_ptr<Panels>> load_panels() {
    const PlugIn plug_in{"tidemark_overlay.so", "overlay plug-in", "the overlay",
                         "Dear ImGui 1.86",     k_panels_entry,    k_panels_version};
    const auto* table = TRY(load_plug_in<PanelsPlugIn>(plug_in));
    return table->create();
}

/// Returns whether all open panels are short messages: the last one of the list.
bool only_messages(const Model::Panels& open) {
    return std::none_of(open.begin(), open.end() - 1, [](bool panel) { return panel; });
}

} // namespace

Result<void> PanelLayer::show(Model model, const Surface& surface) {
    const Model::Panels open = model.panels();
    const bool visible = open != Model::Panels{} && !failed_;
    if (std::exchange(open_, open) != open)
        frames_wanted_ = k_frames_to_settle;
    if (!visible && visible_)
        panels_->release_all();
    visible_ = false;
    if (!visible)
        return {};
    if (!panels_) {
        auto loaded = load_panels();
        if (!loaded && only_messages(open))
            return {}; // nothing that the user has opened
        failed_ = true;
        panels_ = TRY(std::move(loaded));
        failed_ = false;
    }
    visible_ = true;
    panels_->show(std::move(model), surface);
    return {};
}

bool PanelLayer::take(const host::InputEvent& event) {
    if (!visible_)
        return false;
    frames_wanted_ = k_frames_to_settle;
    return panels_->take(event);
}

void PanelLayer::draw() {
    if (!visible_)
        return;
    panels_->draw();
    --frames_wanted_;
}

Commands PanelLayer::take_commands() {
    return panels_ ? panels_->take_commands() : Commands{};
}

} // namespace tidemark::overlay

namespace tidemark::window {
namespace {

/// Starts a program with that standard input, which may go on after its first process has ended. Fails if it
/// is not installed, or ends with an error at once.
Result<void> start_detached(const std::vector<std::string>& words, std::string_view input) {
    const int file = ::memfd_create("tidemark-clipboard", MFD_CLOEXEC);
    const Descriptor descriptor(file);
    if (file < 0 || write_all(file, std::as_bytes(std::span(input))) != 0 || ::lseek(file, 0, SEEK_SET) != 0)
        return fail(ErrorCode::write, "there is no memory for the picture");
    const std::vector<char*> arguments = argument_pointers(words);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, file, STDIN_FILENO);
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    const int error = ::posix_spawnp(&child, arguments[0], &files, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    if (error != 0)
        return fail(ErrorCode::write,
                    fmt::format("'{}' is not installed, which copies pictures", words.front()));
    constexpr int k_steps = 100;
    int status = 0;
    for (int step = 0; step < k_steps; ++step) { // it goes on in the background then
        if (::waitpid(child, &status, WNOHANG) == child)
            return status == 0 ? Result<void>()
                               : fail(ErrorCode::write, fmt::format("'{}' failed", words.front()));
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    std::thread([child] { ::waitpid(child, nullptr, 0); }).detach(); // prevents a zombie
    return {};
}

} // namespace

Result<std::unique_ptr<Screen>> WindowScreen::open(Extent size, const std::string& title,
                                                   const window::WindowWishes& wishes,
                                                   const std::optional<Output>& output) {
    auto window = TRY(window::Window::create(size, title, wishes));
    std::unique_ptr<WindowScreen> screen(new WindowScreen(std::move(window)));
    if (output)
        screen->output_ =
            TRY(window::OutputWindow::create(screen->window_, size, title + " output", output->monitor));
    return screen;
}

std::vector<host::InputEvent> WindowScreen::wait(double seconds) {
    auto events = seconds > 0 ? window_.wait(seconds) : window_.poll();
    listen_to_output(events);
    return events;
}

/// Takes the events of the output window. Its keys act as in the first window; closing it closes only itself.
void WindowScreen::listen_to_output(std::vector<host::InputEvent>& events) {
    if (!output_)
        return;
    for (host::InputEvent event : output_->take_events()) {
        if (std::holds_alternative<host::CloseRequested>(event))
            return output_.reset();
        if (std::holds_alternative<host::FramebufferResized>(event))
            event = host::RedrawNeeded{};
        events.push_back(event);
    }
}

void WindowScreen::show_on_output(const gl::RenderTarget& picture) {
    if (!output_ || output_->framebuffer_extent().pixels() == 0)
        return;
    const host::KeepCurrent current;
    if (auto entered = output_->make_current(); !entered) {
        host::say(to_string(entered.error()));
        return output_.reset();
    }
    gl::blit_fitted(picture, output_->framebuffer_extent());
    output_->swap();
}

/// Starts the program of the desktop that keeps a picture for other programs: wl-copy, or xclip under X11.
Result<void> WindowScreen::set_clipboard_picture(std::string png) {
    const char* const wayland = std::getenv("WAYLAND_DISPLAY");
    const std::vector<std::string> words =
        wayland && *wayland
            ? std::vector<std::string>{"wl-copy", "--type", "image/png"}
            : std::vector<std::string>{"xclip", "-selection", "clipboard", "-t", "image/png", "-i"};
    return start_detached(words, png);
}

/// Returns false for a minimised window, which has no pixels on some systems.
bool WindowScreen::is_watched() const {
    return extent().width > 0 && extent().height > 0;
}

void WindowScreen::begin(const gl::RenderTarget* picture, bool) {
    if (!picture)
        return gl::clear_window();
    show_on_output(*picture);
    gl::blit_to_window(*picture, extent());
}

Result<void> WindowScreen::finish(overlay::Model model, const ShownMoment&) {
    auto shown = panels_.show(std::move(model), {extent(), window_.content_scale()});
    panels_.draw();
    window_.swap();
    return shown;
}

std::shared_ptr<void> WindowScreen::when_lost(std::function<void(std::string_view what)> act) {
    return std::make_shared<window::WhenDisplayIsLost>(std::move(act));
}

} // namespace tidemark::window
