// Live inputs of a window: OSC, MIDI, microphone and webcam.
//
// Prints messages about live inputs, which may repeat a thousand times a second: each once, and at most 32.
#pragma once

#include "host/overlay_model.hpp"
#include "media/sound_device.hpp"
#include "media/video_input.hpp"
#include "render/channel_textures.hpp"
#include "window/midi.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::window {

class SaidOnce {
public:
    void say(std::string_view line);

private:
    static constexpr size_t k_most_lines = 32;
    static constexpr size_t k_longest = 300; ///< bytes; the rest of a message is cut off

    std::set<std::string, std::less<>> said_;
};

// The live inputs of a window. Opens those that were requested; threads receive their data, and the window
// takes it as commands. Opens and loads nothing else.

/// The options as typed.
struct LiveInputRequest {
    std::optional<std::string> osc{};        ///< PORT or HOST:PORT
    std::optional<std::string> midi{};       ///< part of a port's name, or a device file
    std::optional<std::string> microphone{}; ///< an ALSA device
    std::optional<std::string> webcam{};     ///< a device file or a video

    bool any() const { return osc || midi || microphone || webcam; }
    bool turns_knobs() const { return osc || midi; }
};

/// Prints which inputs a recording does not contain.
void say_what_is_not_recorded(const LiveInputRequest& request);

class LiveInputs {
public:
    /// Opens the inputs and prints the OSC address. `wake` wakes the window, which must outlive this. Fails
    /// where an input cannot be opened.
    static Result<std::unique_ptr<LiveInputs>> open(const LiveInputRequest& request,
                                                    const std::function<void()>& wake);

    /// Returns whether `take` has data to return.
    bool any() { return !osc_.empty() || !midi_.empty(); }
    /// Returns the commands since the last call. `knobs` have their current values; `controllers` are the
    /// MIDI bindings, which may be changed.
    overlay::Commands take(std::vector<scene::Knob> knobs, ControllerMap& controllers);

    /// Captures sound and webcam picture for the next frame.
    void hear();
    /// Returns the data of the last `hear`; null before the first one.
    const std::shared_ptr<const render::LiveMedia>& media() const { return media_; }
    bool has_midi() const { return midi_port_ || midi_receiver_; }

private:
    explicit LiveInputs(const std::function<void()>& wake);
    Result<void> open_osc(const std::string& where);
    Result<void> open_midi(const std::string& what);
    void take_osc(overlay::Commands& commands, std::vector<scene::Knob>& knobs);
    void take_midi(overlay::Commands& commands, std::vector<scene::Knob>& knobs, ControllerMap& controllers);

    std::optional<sound::Microphone> microphone_;
    std::optional<image::Camera> webcam_;
    std::shared_ptr<const render::LiveMedia> media_;
    Inbox osc_;
    Inbox midi_;
    MidiParser midi_parser_;
    std::unique_ptr<Receiver> osc_receiver_; ///< declared after the inboxes it writes to
    std::unique_ptr<Receiver> midi_receiver_;
    std::unique_ptr<MidiPort> midi_port_;
    SaidOnce words_;
};

} // namespace tidemark::window
