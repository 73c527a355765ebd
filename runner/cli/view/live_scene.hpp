// A scene as its files are at the moment, there or not: watched, loaded anew when one is saved, and built
// beside the picture on show. Whatever goes wrong is kept for people to read until a save mends it, and the
// last good Stage, if there was one, stays with its user.
#pragma once

#include "cli/requests.hpp"
#include "cli/view/held_values.hpp"
#include "cli/view/stage_builder.hpp"
#include "platform/file_watcher.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::cli {

/// When what happened between saving and seeing, as now_seconds counts.
struct ReloadTimes {
    double saved = 0;
    double seen = 0;
    double loaded = 0;
    double compiled = 0;
};

class LiveScene {
public:
    /// A scene with its overrides, or why there is none.
    struct Loading {
        Result<scene::Scene> scene;
        std::vector<HeldValue> held{}; ///< what its files say of the values that overrides hold
        double begun = 0;              ///< by the file system's clock
    };

    /// How the picture is built: what `follow` needs to know of the window.
    struct View {
        std::function<Result<platform::SharedContext>()> make_context;
        render::RenderOptions options;
        render::FrameInputs inputs; ///< of the next frame, about
        std::shared_ptr<Rehearsal> rehearsal{};
    };

    /// Prints the scene's warnings. Options that do not fit the scene are an ErrorCode::usage. `before`: what
    /// its files said of held values when it was on show last.
    static Loading load(const SceneRequest& request, const std::vector<HeldValue>& before = {});

    /// Watches the files of `request`, of which `first` is the first look, and begins to build it or waits
    /// for what mends it. `wake` is called, on any thread, when there is something to do.
    static Result<LiveScene> create(SceneRequest request, Loading first, const View& view,
                                    const std::function<void()>& wake);

    /// Looks after changed files and finished work. Gives a Stage once it is good. Fails where no save can
    /// help: the options do not fit the scene that it was created with, or there is no context.
    Result<std::optional<Stage>> follow(const View& view, double now);

    enum class Settle { no, yes };
    /// Begins to build the scene on show again: as it was first, or to look for a quicker program, which
    /// `follow` gives if there is one. A reload goes first.
    void build_anew(const scene::Scene& scene, const View& view, Settle settle);

    /// A quicker program that is looked for is not wanted any more.
    void stop_settling();

    /// Holds a definition at a value as `--define` does; none: it is the files' own again. A reload follows.
    void define(const std::string& name, const std::optional<std::string>& value, const View& view);

    /// The same of all of them: `NAME=VALUE`.
    void hold(std::vector<std::string> defines, const View& view);

    /// The build under way is not wanted any more.
    void give_up();

    const std::string& name() const { return name_; }
    /// What the scene on show was asked for: options that the file has overruled are gone.
    const SceneRequest& request() const { return request_; }
    /// What is wrong with the files as they are. Not while it may be the middle of a save.
    const Error* failure() const { return failure_ && !report_at_ ? &*failure_ : nullptr; }
    /// Since when there is something being built that people wait for.
    std::optional<double> building_since() const;
    /// When `follow` wants to be called at the latest.
    std::optional<double> wake_at() const { return report_at_; }
    /// Of the Stage that `follow` gave last, when it was a reload; once.
    std::optional<ReloadTimes> take_times() { return std::exchange(times_of_stage_, std::nullopt); }
    /// A driver is at work that cannot be stopped: StageBuilder::busy.
    bool busy() const { return builder_.busy(); }

private:
    LiveScene(SceneRequest request, platform::FileWatcher watcher, const std::function<void()>& wake);

    Result<void> build(scene::Scene scene, const View& view, Settle settle = Settle::no);
    void reload(const View& view);
    Result<void> begin(Loading loading, const View& view);
    Loading watched(Loading loading);
    std::vector<std::filesystem::path> files_of(const Result<scene::Scene>& scene) const;
    std::vector<platform::FileWatcher::Change> changed();
    void fail_with(Error error);
    void report_failure();
    void mended();

    SceneRequest request_;
    platform::FileWatcher watcher_;
    std::string name_;
    std::vector<std::filesystem::path> files_;     ///< of the scene that loaded last
    std::vector<std::filesystem::path> watched_;   ///< what the watcher was asked for
    std::vector<std::filesystem::path> in_folder_; ///< of a scene that is a folder: what makes it one
    std::vector<HeldValue> held_;                  ///< of the scene that was built last
    std::vector<HeldValue> held_on_show_;
    std::optional<Error> failure_;     ///< of the last load or build, until mended
    std::optional<double> report_at_;  ///< when the failure is news; before, a file may be half-written
    std::optional<ReloadTimes> times_; ///< of the build under way
    std::optional<ReloadTimes> times_of_stage_;
    double building_since_ = 0;
    bool saved_ = false;    ///< a file was, since the start
    bool shown_ = false;    ///< there was a Stage
    bool waits_ = false;    ///< it was said that there is none yet
    bool settling_ = false; ///< what is being built, if anything, is a settled Stage
    StageBuilder builder_;
};

} // namespace tidemark::cli
