// State of the overlay over the picture: error panel, messages, undo history, contents of the panels. Also
// opens the user's editor.
//
// The error on show, with the source lines it refers to.
#pragma once

#include "base/error.hpp"
#include "host/overlay_model.hpp"
#include "host/presets.hpp"
#include "host/requests.hpp"
#include "scene/scene.hpp"
#include "window/midi.hpp"

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::window {

class ErrorBoard {
public:
    /// Sets the error; null: there is none. Reads the files if the error differs from the last one. Returns
    /// whether it differs.
    bool show(const Error* error, const scene::UnsavedTexts& unsaved = {});
    const std::vector<overlay::ErrorField>& fields() const { return fields_; }

private:
    std::string text_; ///< of the error
    std::vector<overlay::ErrorField> fields_;
};

// Opens the user's own editor at a place in a file. Uses no shell and does not wait for it.

/// Returns the command that opens the editor ("code --wait": split at blanks) at that place. A terminal
/// editor is opened in x-terminal-emulator.
std::vector<std::string> editor_words(std::string_view editor, const SourceLocation& where);

/// Opens $VISUAL, else $EDITOR. Fails (ErrorCode::usage) if neither is set or it does not start.
Result<void> open_editor(const SourceLocation& where);

// Short messages over the picture. Each belongs to a topic, whose earlier message it replaces, and fades.

class Messages {
public:
    static constexpr double k_seconds = 3;

    /// Shows no messages from now on.
    void turn_off() { on_ = false; }
    /// Shows a text for that long; infinity: until `end`.
    void tell(std::string_view topic, std::string text, double now, double seconds = k_seconds);
    /// Changes the text of a topic that is still shown.
    void retell(std::string_view topic, const std::string& text);
    void end(std::string_view topic);

    /// Returns whether they must be shown again at that time; the caller does so then.
    bool take_due(double now);
    /// Returns when `take_due` will return true; infinity: not by itself.
    double due() const { return due_; }
    /// Returns the messages to show, the oldest first.
    std::vector<overlay::MessageField> fields(double now);

private:
    struct Entry {
        std::string topic;
        std::string text;
        double until;
    };
    bool on_ = true;
    std::vector<Entry> entries_;
    double due_ = std::numeric_limits<double>::infinity();
};

// The user's changes, step by step, for undo and redo.

/// All that Ctrl+Z brings back.
struct Edits {
    std::vector<scene::KnobSetting> knobs{}; ///< values that differ from the scene's
    render::OrbitCamera camera{};
    std::vector<std::string> defines{};
    std::shared_ptr<const std::vector<host::Preset>> views{};

    bool operator==(const Edits&) const = default;
};

/// Returns the names of what differs: `height, camera`.
std::string changed_words(const Edits& before, const Edits& after);

class History {
public:
    /// Call it after each change by the user. Changes while a mouse button is `held` are one step, and so are
    /// changes of the same values within half a second of each other.
    void follow(Edits now, double time, bool held);
    /// Takes the current edits without a step, for changes that the user did not make.
    void adopt(Edits now) { current_ = std::move(now); }
    /// Return the edits of the step before, or of the step that was undone last; nothing without such a step.
    std::optional<Edits> undo();
    std::optional<Edits> redo();
    const std::optional<Edits>& current() const { return current_; }

private:
    std::optional<Edits> go(std::vector<Edits>& from, std::vector<Edits>& to);

    std::optional<Edits> current_; ///< none before the first call
    std::vector<Edits> before_;
    std::vector<Edits> undone_;
    double changed_at_ = -std::numeric_limits<double>::infinity();
    std::string changed_; ///< names of what the last step changed
    bool held_ = false;
};

// The contents of the panels over the picture, apart from the picture and its time. The window carries out
// the panels' commands.

/// Returns the scene's knobs with their current values: the defaults after `turned`.
std::vector<overlay::KnobField> knob_fields(const scene::Scene& scene,
                                            const std::vector<scene::KnobSetting>& turned);

/// Returns the numeric definitions in the scene's texts, with the overrides of `request`.
std::vector<overlay::DefinitionField> definition_fields(const scene::Scene& scene,
                                                        const host::SceneRequest& request);

class Overlay {
public:
    enum class Panel { controls, help };

    explicit Overlay(bool controls_open) : controls_open_(controls_open) {}

    bool shows(Panel panel) const { return panel == Panel::help ? help_open_ : controls_open_; }
    /// Opens or closes a panel.
    void toggle(Panel panel);
    /// Requests to show the panels again, because they are out of date.
    void mark_changed() { changed_ = true; }
    /// Requests it if `changed` is true.
    void mark_changed_if(bool changed) { changed_ |= changed; }
    bool changed() const { return changed_; }

    /// Sets the error of the scene's files, or of an editor's texts in their place; null: none.
    void show_error(const Error* error, const scene::UnsavedTexts& unsaved = {}) {
        mark_changed_if(errors_.show(error, unsaved));
    }
    /// Sets the origin of a NaN, shown while the files have no error; null: none. Returns whether it differs.
    bool show_origin(const Error* origin);
    /// Forgets the texts of the scene on show: another one is on show from now on.
    void forget_scene();

    /// Adds a view that the user keeps, under a name that no other has. Returns name and label.
    std::string keep(host::Preset view);
    void forget_view(size_t index);
    /// Fails (ErrorCode::usage) if the name is empty or another view has it.
    Result<void> rename_view(size_t index, const std::string& name);
    const std::vector<host::Preset>& views() const { return *views_; }
    /// The same, as a value that later changes do not touch.
    std::shared_ptr<const std::vector<host::Preset>> kept_views() const { return views_; }
    void set_views(std::shared_ptr<const std::vector<host::Preset>> views);
    double morph_seconds() const { return morph_seconds_; }
    void set_morph(double seconds);

    Messages& messages() { return messages_; }
    const Messages& messages() const { return messages_; }

    /// Bindings of MIDI controllers, of this scene, also without a device.
    ControllerMap& controllers() { return controllers_; }
    const ControllerMap& controllers() const { return controllers_; }

    /// Restores what the last window kept.
    void restore(bool controls_open, double morph_seconds, std::vector<Binding> controllers);

    /// Returns the panels' contents, which are up to date from then on. `scene`: on show; null: none yet, and
    /// the controls stay closed. `turned`: values of its knobs. `midi`: there is a MIDI device.
    overlay::Model model(const scene::Scene* scene, const host::SceneRequest& request,
                         const std::vector<scene::KnobSetting>& turned, bool midi, double now = 0);

    /// Sets the window's title; returns whether it differs from the last one.
    bool change_title(const std::string& title);

private:
    bool controls_open_;
    bool help_open_ = false;
    bool changed_ = false;
    ErrorBoard errors_;
    ErrorBoard origin_;
    std::shared_ptr<const std::vector<host::Preset>> views_ = std::make_shared<std::vector<host::Preset>>();
    double morph_seconds_ = 0;
    Messages messages_;
    ControllerMap controllers_;
    std::optional<std::vector<overlay::DefinitionField>>
        definitions_; ///< of the scene on show; none: not read yet
    std::string title_;
};

} // namespace tidemark::window
