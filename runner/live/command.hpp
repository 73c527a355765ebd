// What people ask for in the overlay, as plain values: whoever owns the window carries them out.
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
/// The next controller of a MIDI device that moves turns that component.
struct LearnController {
    std::string knob;
    size_t component = 0;
};
struct ForgetController {
    std::string knob;
    size_t component = 0;
};
/// Into the clipboard, as options.
struct CopyKnobs {};
/// Into the file that declares them.
struct WriteKnobs {};

/// At that place.
struct OpenEditor {
    SourceLocation where;
};

/// As `--define` does.
struct Define {
    std::string name;
    std::string value;
};
struct Undefine {
    std::string name;
};

/// Of Model::pictures; none: the scene's own.
struct ShowPicture {
    std::optional<size_t> index{};
};

/// At the one that is large.
struct LookAtPicture {
    LookField look{};
};

/// The moment on show into the list of views.
struct KeepView {};
/// Of Model::views.
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
/// Stays at the frame that was reached.
struct GiveUpSeek {};
struct SetSpeed {
    double speed = 1;
};
/// With both ends time goes round between them.
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
