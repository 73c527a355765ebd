#include "cli/view/live_scene.hpp"

#include "cli/console.hpp"
#include "cli/view/wall_clock.hpp"
#include "scene/folder_scene.hpp"

#include <fmt/format.h>

namespace tidemark::cli {
namespace {

/// How long a scene that does not load may still be in the middle of being saved. An editor's pause between
/// two writes is shorter, a person's patience longer.
constexpr double k_half_written_seconds = 0.06;

void keep_turned_knobs(const std::vector<scene::Knob>& before, scene::Scene& fresh) {
    for (const scene::Knob& old : before)
        for (scene::Knob& knob : fresh.knobs)
            if (knob.name == old.name && knob.type == old.type && old.value != old.initial)
                knob.value = old.value;
}

} // namespace

LiveScene::LiveScene(SceneRequest request, platform::FileWatcher watcher, const scene::Scene& scene)
    : request_(std::move(request)), watcher_(std::move(watcher)), name_(scene.name()), files_(scene.files),
      knobs_(scene.knobs), in_folder_(scene::scene_files_in(request_.path)),
      builder_([] { platform::Window::wake(); }) {
    request_.sets.clear(); // they are among the knobs that were turned
    request_.said = scene.warnings;
}

Result<LiveScene> LiveScene::create(SceneRequest request, scene::Scene scene, platform::Window& window,
                                    const View& view) {
    auto watcher = platform::FileWatcher::create([] { platform::Window::wake(); });
    if (!watcher)
        return fail(std::move(watcher.error()));
    LiveScene live(std::move(request), *std::move(watcher), scene);
    if (auto watched = live.watch(live.files_); !watched)
        say(to_string(watched.error())); // it can still be looked at
    if (auto begun = live.build(std::move(scene), window, view); !begun)
        return fail(std::move(begun.error()));
    return live;
}

/// Those files, and of a scene that is a folder the files that it may get.
Result<void> LiveScene::watch(std::vector<std::filesystem::path> files) {
    std::error_code ignored;
    if (std::filesystem::is_directory(request_.path, ignored))
        files.push_back(request_.path / "");
    return watcher_.watch(files);
}

/// Files that were saved. In a folder many a thing comes and goes that no scene is made of.
std::vector<std::filesystem::path> LiveScene::changed() {
    std::vector<std::filesystem::path> files = watcher_.changed();
    if (std::erase(files, request_.path / "") > 0) {
        auto in_folder = scene::scene_files_in(request_.path);
        if (in_folder != std::exchange(in_folder_, in_folder))
            files.push_back(request_.path / "");
    }
    return files;
}

Result<void> LiveScene::build(scene::Scene scene, platform::Window& window, const View& view, bool settle) {
    auto context = window.create_context();
    if (!context)
        return fail(std::move(context.error()));
    building_since_ = now_seconds();
    settling_ = settle;
    builder_.start(
        {*std::move(context), std::move(scene), view.options, view.inputs, settle, view.rehearsal});
    return {};
}

void LiveScene::settle(const scene::Scene& scene, platform::Window& window, const View& view) {
    (void)build(scene, window, view, true); // where it fails, what shows the scene now goes on doing so
}

std::optional<double> LiveScene::building_since() const {
    return builder_.building() && !settling_ ? std::optional(building_since_) : std::nullopt;
}

Result<std::optional<Stage>> LiveScene::follow(platform::Window& window, const View& view, double now) {
    if (const auto files = changed(); !files.empty()) {
        saved_ = true;
        times_.emplace();
        std::error_code ignored;
        times_->saved = std::filesystem::last_write_time(files.front(), ignored);
        times_->seen = now;
        reload(window, view, now);
    }
    if (report_at_ && now >= *report_at_) {
        report_at_.reset();
        say(to_string(*failure_));
    }
    auto built = builder_.take();
    if (!built)
        return std::nullopt;
    if (settling_)
        return *built ? std::optional(**std::move(built)) : std::nullopt;
    if (!*built && !saved_)
        return fail(std::move(built->error()));
    if (!*built) {
        fail_with(std::move(built->error()), now);
        return std::nullopt;
    }
    mended();
    if (times_)
        times_->compiled = now_seconds();
    times_of_stage_ = std::exchange(times_, std::nullopt);
    return std::move(**built);
}

void LiveScene::reload(platform::Window& window, const View& view, double now) {
    builder_.abandon();
    auto scene = load_again();
    if (!scene)
        return fail_with(std::move(scene.error()), now);
    times_->loaded = now_seconds();
    if (auto begun = build(*std::move(scene), window, view); !begun)
        fail_with(std::move(begun.error()), now);
}

Result<scene::Scene> LiveScene::load_again() {
    auto scene = load(request_);
    if (!scene) {
        // What is missing or wrong may be a file that the last good scene did not have.
        std::vector<std::filesystem::path> files = files_;
        files.insert(files.end(), scene.error().files.begin(), scene.error().files.end());
        (void)watch(std::move(files)); // a folder that is missing too cannot be watched: the rest is
        return scene;
    }
    keep_turned_knobs(knobs_, *scene);
    knobs_ = scene->knobs;
    files_ = scene->files;
    request_.said = scene->warnings;
    name_ = scene->name();
    // Before the slow part, so that a save during it is seen; and even if it fails, so that what it waits for
    // is seen.
    if (auto watched = watch(files_); !watched)
        return fail(std::move(watched.error()));
    return scene;
}

void LiveScene::fail_with(Error error, double now) {
    failure_ = std::move(error);
    report_at_ = now + k_half_written_seconds;
}

void LiveScene::mended() {
    if (failure_ && !report_at_)
        say(fmt::format("{}: good again", request_.path.string()));
    failure_.reset();
    report_at_.reset();
}

void LiveScene::give_up() {
    builder_.abandon();
    times_.reset();
}

} // namespace tidemark::cli
