// The overlay's interface as plain values: the model to show, the commands that come back, and the owner of
// each event.
//
// Everything that the overlay shows, as plain values. The owner of the window makes a new one for each frame.
#pragma once

#include "host/input_events.hpp"
#include "host/overlay_fields.hpp"
#include "scene/knob.hpp"

#include <array>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace tidemark::overlay {

/// An input and its effect.
struct HelpRow {
    std::string keys;
    std::string meaning;
};

struct Model {
    bool controls = false; ///< the controls are open; only then everything down to `front` is shown
    std::vector<KnobField> knobs{};
    std::vector<DefinitionField> definitions{};
    std::vector<PictureField> pictures{};
    std::optional<size_t> large{}; ///< index of the picture that is shown large
    LookField look{};              ///< how that one is viewed
    std::vector<ViewField> views{};
    double morph_seconds = 0; ///< how long going to a view takes
    TimeField time{};
    Extent extent{}; ///< of the scene's picture
    LensChooser lenses{};
    HotLinesField hot_lines{};
    std::optional<FrontField> front{}; ///< none: no knob was turned
    std::optional<SoundField> sound{}; ///< none: there is nothing to hear

    std::vector<ErrorField> errors{}; ///< most important first; the panel is open while there are any
    std::vector<HelpRow> help{};      ///< the panel is open while there are any
    std::string help_footer{};

    std::optional<MagnifierField> magnifier{};
    std::string clock{};                 ///< progress of a slow frame; empty: none is being drawn
    std::vector<GalleryField> gallery{}; ///< it fills the window while there are any
    size_t selected = 0;                 ///< index of the scene that Enter opens
    std::optional<LensField> lens{};     ///< none: the picture itself is on show
    std::string status{};                ///< the status line; empty: it is closed
    std::vector<MessageField> messages{};

    /// The open panels.
    using Panels = std::array<bool, 9>;
    Panels panels() const {
        return {controls,         !errors.empty(),  !help.empty(),   magnifier.has_value(), !clock.empty(),
                !gallery.empty(), lens.has_value(), !status.empty(), !messages.empty()};
    }
};

// Requests made in the overlay, as plain values. The owner of the window carries them out.

struct TurnKnob {
    std::string name;
    scene::KnobValue value{};
};
struct ResetKnob {
    std::string name;
};
struct ResetKnobs {};
/// Binds the next MIDI controller that moves to that component.
struct LearnController {
    std::string knob;
    size_t component = 0;
};
struct ForgetController {
    std::string knob;
    size_t component = 0;
};
/// Copies the changed knobs to the clipboard, as options.
struct CopyKnobs {};
/// Writes the changed knobs into the files that declare them.
struct WriteKnobs {};

/// Opens the user's editor at that place.
struct OpenEditor {
    SourceLocation where;
};

/// Replaces a definition, as `--define` does.
struct Define {
    std::string name;
    std::string value;
};
struct Undefine {
    std::string name;
};

/// Shows one of Model::pictures large; none: the scene's own picture.
struct ShowPicture {
    std::optional<size_t> index{};
};

/// Sets how the large picture is viewed.
struct LookAtPicture {
    LookField look{};
};

/// Adds the moment on show to the list of views.
struct KeepView {};
/// Goes to one of Model::views.
struct GoToView {
    size_t index = 0;
};
struct ForgetView {
    size_t index = 0;
};
struct RenameView {
    size_t index = 0;
    std::string name;
};
/// Sets how long going to a view takes; 0: it is there at once, with its time.
struct SetMorph {
    double seconds = 0;
};

/// Opens one of Model::gallery.
struct OpenScene {
    size_t index = 0;
};
/// The number of scenes in a row of the gallery, as it is drawn now.
struct GalleryColumns {
    size_t count = 1;
};

/// Shows a lens, as `--lens` takes it; empty: the picture.
struct SetLens {
    std::string lens;
};
/// Counts the lines that cost most, as long as they are shown.
struct WatchHotLines {
    bool open = true;
};

struct TogglePause {};
struct SetPlaying {
    bool on = true;
};
struct Restart {};
struct Seek {
    double seconds = 0;
};
/// The bar of time is pressed, or released.
struct HoldBar {
    bool held = true;
};
/// Doubles the range of the bar of time.
struct GrowBar {};
/// Cancels a seek and stays at the frame that was reached.
struct GiveUpSeek {};
struct SetSpeed {
    double speed = 1;
};
/// Repeats the time between the two ends; a missing end turns the loop off.
struct SetLoop {
    std::optional<double> from{};
    std::optional<double> to{};
};

/// Sets the volume of the scene's sound.
struct SetVolume {
    SoundField sound;
};

using Command =
    std::variant<TurnKnob, ResetKnob, ResetKnobs, LearnController, ForgetController, CopyKnobs, WriteKnobs,
                 OpenEditor, Define, Undefine, ShowPicture, LookAtPicture, KeepView, GoToView, ForgetView,
                 RenameView, SetMorph, OpenScene, GalleryColumns, TogglePause, SetPlaying, Restart, Seek,
                 HoldBar, GrowBar, GiveUpSeek, SetSpeed, SetLoop, SetVolume, SetLens, WatchHotLines>;
using Commands = std::vector<Command>;

// Decides whether an event belongs to the panels or to the scene. A press and its release have the same
// owner, wherever the pointer has moved in between.

class EventOwner {
public:
    /// The kinds of events that the panels would take at the moment.
    struct Wishes {
        bool pointer = false; ///< the pointer is over a panel
        bool text = false;    ///< a text field has the keyboard
    };

    /// Returns whether the event belongs to the panels. Call it once for each event, in order.
    bool take(const host::InputEvent& event, const Wishes& wishes);
    void release_all();

private:
    std::set<host::Button> buttons_; ///< pressed on a panel and still down
    std::set<host::Key> keys_;       ///< pressed in a text field and still down
};

} // namespace tidemark::overlay
