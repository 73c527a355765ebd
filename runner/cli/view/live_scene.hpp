// A scene as its files are at the moment: watched, loaded anew when one is saved, and built beside the
// picture on show. Whatever goes wrong is kept for people to read, and the last good Stage stays with its
// user.
#pragma once

#include "cli/requests.hpp"
#include "cli/view/stage_builder.hpp"
#include "platform/file_watcher.hpp"
#include "platform/window.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::cli {

/// When what happened between saving and seeing; wall clock but for the file's own time.
struct ReloadTimes {
    std::filesystem::file_time_type saved{};
    double seen = 0;
    double loaded = 0;
    double compiled = 0;
};

class LiveScene {
public:
    /// How the picture is built: what `follow` needs to know of the window.
    struct View {
        render::RenderOptions options;
        render::FrameInputs inputs; ///< of the next frame, about
        std::shared_ptr<Rehearsal> rehearsal{};
    };

    /// Watches the files of `scene`, which is what `request` asked for, and begins to build it. `window` is
    /// woken when there is something to do: it must live longer.
    static Result<LiveScene> create(SceneRequest request, scene::Scene scene, platform::Window& window,
                                    const View& view);

    /// Looks after changed files and finished work. Gives a Stage once it is good; fails when the scene that
    /// it was created with cannot be built.
    Result<std::optional<Stage>> follow(platform::Window& window, const View& view, double now);

    /// Begins to look for a quicker program for the scene on show, which `follow` gives if there is one. A
    /// reload goes first. Nothing else may be under way.
    void settle(const scene::Scene& scene, platform::Window& window, const View& view);

    /// The build under way is not wanted any more.
    void give_up();

    const std::string& name() const { return name_; }
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
    LiveScene(SceneRequest request, platform::FileWatcher watcher, const scene::Scene& scene);

    Result<void> build(scene::Scene scene, platform::Window& window, const View& view, bool settle = false);
    void reload(platform::Window& window, const View& view, double now);
    Result<scene::Scene> load_again();
    Result<void> watch(std::vector<std::filesystem::path> files);
    std::vector<std::filesystem::path> changed();
    void fail_with(Error error, double now);
    void mended();

    SceneRequest request_;
    platform::FileWatcher watcher_;
    std::string name_;
    std::vector<std::filesystem::path> files_;     ///< of the scene that loaded last
    std::vector<scene::Knob> knobs_;               ///< likewise
    std::vector<std::filesystem::path> in_folder_; ///< of a scene that is a folder: what made it one, last
    std::optional<Error> failure_;                 ///< of the last reload, until mended
    std::optional<double> report_at_;  ///< when the failure is news; before, a file may be half-written
    std::optional<ReloadTimes> times_; ///< of the build under way
    std::optional<ReloadTimes> times_of_stage_;
    double building_since_ = 0;
    bool saved_ = false;    ///< a file was, since the start
    bool settling_ = false; ///< what is being built, if anything, is a settled Stage
    StageBuilder builder_;
};

} // namespace tidemark::cli
