// Requests made in the overlay, as plain values. The owner of the window carries them out.
#pragma once

#include "live/look_field.hpp"
#include "scene/knob.hpp"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace tidemark::live {

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

struct TogglePause {};
struct SetPlaying {
    bool on = true;
};
struct Restart {};
struct Seek {
    double seconds = 0;
};
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

using Command =
    std::variant<TurnKnob, ResetKnob, ResetKnobs, LearnController, ForgetController, CopyKnobs, WriteKnobs,
                 OpenEditor, Define, Undefine, ShowPicture, LookAtPicture, KeepView, GoToView, ForgetView,
                 TogglePause, SetPlaying, Restart, Seek, GiveUpSeek, SetSpeed, SetLoop>;
using Commands = std::vector<Command>;

} // namespace tidemark::live
