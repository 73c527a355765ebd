// A scene that follows its files: overrides by the user, texts of an editor, reloading.
//
// User overrides of the file's defaults, and the messages for edits of an overridden value in the file. A
// `--define` stays; a `--set` ends as soon as the file has another default. Changes no scene.
#pragma once

#include "host/requests.hpp"
#include "window/file_watcher.hpp"
#include "window/stage.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace tidemark::window {

struct HeldValue {
    std::string_view option; ///< `--set`, `--define`
    std::string name;
    std::string value;   ///< as the option gives it
    std::string in_file; ///< as the file has it

    bool is_of(const HeldValue& other) const { return option == other.option && name == other.name; }
};

/// Returns the overrides in `request`. `scene` must be as its files have it, before options change it. Names
/// that the scene does not have are left out.
std::vector<HeldValue> held_values(const host::SceneRequest& request, const scene::Scene& scene);

/// Returns the request without each `--set` whose default in the file has changed since `before`.
host::SceneRequest without_edited(host::SceneRequest request, const std::vector<HeldValue>& before,
                                  const std::vector<HeldValue>& now);

/// Returns a message for each overridden value that has changed in the file.
std::vector<std::string> edits_of_held(const std::vector<HeldValue>& before,
                                       const std::vector<HeldValue>& now);

/// Returns a message for each knob whose default has changed and that keeps the value set in the window.
std::vector<std::string> edits_of_turned(const std::vector<scene::Knob>& before,
                                         const std::vector<scene::Knob>& now,
                                         const std::vector<scene::KnobSetting>& turned);

// The texts of an editor's buffers, saved or not, which are drawn in place of the files on disk.

/// Reads standard input: one JSON object a line, `{"texts": {"/path/a.glsl": "…", "/path/b.glsl": null}}`.
/// Null means that the file counts again. `"note": "…"` beside the texts are words for the title.
class EditorTexts {
public:
    /// Waits for the first line. Fails (ErrorCode::usage) if it has another form or the input has ended.
    static Result<std::shared_ptr<EditorTexts>> open();
    EditorTexts(const EditorTexts&) = delete;
    EditorTexts& operator=(const EditorTexts&) = delete;
    ~EditorTexts();

    /// While it lives, `wake` is called on another thread when there are new texts and at the end of the
    /// input.
    class Waking {
    public:
        Waking(EditorTexts* texts, std::function<void()> wake) : texts_(texts) { set(std::move(wake)); }
        ~Waking() { set(nullptr); }
        Waking(const Waking&) = delete;
        Waking& operator=(const Waking&) = delete;

    private:
        void set(std::function<void()> wake);
        EditorTexts* texts_; ///< may be null
    };

    /// Returns all texts, and the files whose text has changed since the last call; nothing if none has.
    struct Change {
        scene::UnsavedTexts texts;
        std::vector<std::filesystem::path> files;
    };
    std::optional<Change> take();
    /// Returns the words for the title; empty: none.
    std::string note() const;
    /// Returns the texts of the last call of `take`, or of `open`. Also works in a process that was forked
    /// from this one before that call.
    scene::UnsavedTexts shared() const;
    /// Returns whether the input has ended.
    bool ended() const;

private:
    EditorTexts() = default;
    void run();
    bool read_block();
    bool take_lines();
    void share();

    std::string bytes_;        ///< read and not yet split into lines
    mutable std::mutex mutex_; ///< guards the members below
    scene::UnsavedTexts texts_;
    std::vector<std::filesystem::path> changed_;
    std::string note_;
    std::function<void()> wake_;
    bool ended_ = false;
    int shared_ = -1; ///< a file in memory with the texts
    int stop_ = -1;   ///< an event that ends the thread
    std::thread thread_;
};

// A scene whose files are watched: loaded again when one is saved, and built while the last picture stays on
// show. Keeps any error until a save fixes it; the last good Stage stays with its user.

/// The times from a save to the new picture, by now_seconds.
struct ReloadTimes {
    double saved = 0;
    double seen = 0;
    double loaded = 0;
    double compiled = 0;
};

class LiveScene {
public:
    /// A scene with its overrides, or the error.
    struct Loading {
        Result<scene::Scene> scene;
        std::vector<HeldValue> held{}; ///< overridden values, as the files have them
        double begun = 0;              ///< by the file system's clock, in seconds
    };

    /// The data about the window that building a picture needs.
    struct View {
        std::function<Result<host::SharedContext>()> make_context;
        render::RenderOptions options;
        render::FrameInputs inputs; ///< roughly those of the next frame
        std::shared_ptr<Rehearsal> rehearsal{};
    };

    /// Loads the scene and prints its warnings. Options that do not fit the scene are an ErrorCode::usage.
    /// `before`: the overridden values of the scene that was last on show.
    static Loading load(const host::SceneRequest& request, const std::vector<HeldValue>& before = {});

    /// Watches the files of `request`, and starts to build `first`, its first load, or waits for a save that
    /// fixes it. `wake` is called, on any thread, when `follow` has something to do. Fails where no save can
    /// help.
    static Result<LiveScene> create(host::SceneRequest request, Loading first, const View& view,
                                    const std::function<void()>& wake);

    /// Handles changed files and finished builds. Returns a Stage when a new one is ready. Fails where no
    /// save can help: the initial options do not fit the scene, or no context can be created.
    Result<std::optional<Stage>> follow(const View& view, double now);

    enum class Settle { no, yes };
    /// Starts to build the scene on show again: as written, or (Settle::yes) an optimised program, which
    /// `follow` returns if it is faster. A reload replaces this build.
    void build_anew(const scene::Scene& scene, const View& view, Settle settle);

    /// Cancels background optimisation.
    void stop_settling();

    /// Overrides a definition as `--define` does; none: removes the override. Reloads the scene.
    void define(const std::string& name, const std::optional<std::string>& value, const View& view);

    /// Replaces all overrides of definitions by `NAME=VALUE` texts. Reloads the scene.
    void hold(std::vector<std::string> defines, const View& view);

    /// Gives a channel another input, as `--channel N=WHAT` does. Reloads the scene.
    void give_channel(int channel, const std::string& what, const View& view);
    /// Draws an editor's texts in place of the files. Reloads the scene if it reads one that has changed.
    void put(EditorTexts::Change change, const View& view);

    /// Cancels the build in progress.
    void give_up();

    const std::string& name() const { return name_; }
    /// Returns the request for the scene on show, without options that an edit of the file has ended.
    const host::SceneRequest& request() const { return request_; }
    /// Returns the current error of the files; null while it may only be a half-finished save.
    const Error* failure() const { return failure_ && !report_at_ ? &*failure_ : nullptr; }
    /// Returns when the current build began; nothing during background optimisation.
    std::optional<double> building_since() const;
    /// Returns the time by which `follow` must be called.
    std::optional<double> wake_at() const { return report_at_; }
    /// Returns the times of the last Stage from `follow`, if it was a reload, once.
    std::optional<ReloadTimes> take_times() { return std::exchange(times_of_stage_, std::nullopt); }
    /// Returns whether a driver call is running that cannot be cancelled: StageBuilder::busy.
    bool busy() const { return builder_.busy(); }

private:
    LiveScene(host::SceneRequest request, FileWatcher watcher, const std::function<void()>& wake);

    Result<void> build(scene::Scene scene, const View& view, Settle settle = Settle::no);
    void reload(const View& view);
    Result<void> begin(Loading loading, const View& view);
    Loading watched(Loading loading);
    std::vector<std::filesystem::path> files_of(const Result<scene::Scene>& scene) const;
    std::vector<FileWatcher::Change> changed();
    void fail_with(Error error);
    void report_failure();
    void mended();

    host::SceneRequest request_;
    FileWatcher watcher_;
    std::string name_;
    std::vector<std::filesystem::path> files_;     ///< of the scene that loaded last
    std::vector<std::filesystem::path> watched_;   ///< the files given to watcher_
    std::vector<std::filesystem::path> in_folder_; ///< for a folder scene: the files it consists of
    std::vector<HeldValue> held_;                  ///< of the scene that was built last
    std::vector<HeldValue> held_on_show_;
    std::optional<Error> failure_;     ///< of the last load or build, until it is fixed
    std::optional<double> report_at_;  ///< when to report the failure; before, a file may be half saved
    std::optional<ReloadTimes> times_; ///< of the build in progress
    std::optional<ReloadTimes> times_of_stage_;
    double building_since_ = 0;
    bool saved_ = false;    ///< a file was saved since the start
    bool shown_ = false;    ///< there was a Stage
    bool typed_ = false;    ///< the last reload was for a text of an editor, which is never half saved
    bool waits_ = false;    ///< the message that it waits for a save was printed
    bool settling_ = false; ///< the build in progress is background optimisation
    StageBuilder builder_;
};

} // namespace tidemark::window
