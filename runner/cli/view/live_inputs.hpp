// The live inputs of a window: what is asked for is opened, listened to by threads, and handed over as
// commands when the window asks. Nothing is opened, and no library loaded, for what nobody asked for.
#pragma once

#include "cli/view/said_once.hpp"
#include "image/files/camera.hpp"
#include "live/command.hpp"
#include "live/inputs/controller_map.hpp"
#include "live/inputs/midi_port.hpp"
#include "live/inputs/receiver.hpp"
#include "render/live_media.hpp"
#include "sound/microphone.hpp"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::cli {

/// As they are typed.
struct LiveInputRequest {
    std::optional<std::string> osc{};        ///< PORT or HOST:PORT
    std::optional<std::string> midi{};       ///< a part of a port's name, or a device's file
    std::optional<std::string> microphone{}; ///< a device of ALSA's
    std::optional<std::string> webcam{};     ///< a device's file, or a video's

    bool any() const { return osc || midi || microphone || webcam; }
    bool turns_knobs() const { return osc || midi; }
};

/// For somebody who records.
void say_what_is_not_recorded(const LiveInputRequest& request);

class LiveInputs {
public:
    /// Wakes the window, which must live longer, and says where it listens. Fails where an input cannot be
    /// had.
    static Result<std::unique_ptr<LiveInputs>> open(const LiveInputRequest& request,
                                                    const std::function<void()>& wake);

    /// Whether `take` has anything to give.
    bool any() { return !osc_.empty() || !midi_.empty(); }
    /// What was asked for since the last call, of a scene whose knobs are turned so, by controllers that are
    /// bound so.
    live::Commands take(std::vector<scene::Knob> knobs, live::ControllerMap& controllers);

    /// What the next frame hears and sees.
    void hear();
    /// What the last frame did; null before it.
    const std::shared_ptr<const render::LiveMedia>& media() const { return media_; }
    bool has_midi() const { return midi_port_ || midi_receiver_; }

private:
    explicit LiveInputs(const std::function<void()>& wake);
    Result<void> open_osc(const std::string& where);
    Result<void> open_midi(const std::string& what);
    void take_osc(live::Commands& commands, std::vector<scene::Knob>& knobs);
    void take_midi(live::Commands& commands, std::vector<scene::Knob>& knobs,
                   live::ControllerMap& controllers);

    std::optional<sound::Microphone> microphone_;
    std::optional<image::Camera> webcam_;
    std::shared_ptr<const render::LiveMedia> media_;
    live::Inbox osc_;
    live::Inbox midi_;
    live::MidiParser midi_parser_;
    std::unique_ptr<live::Receiver> osc_receiver_; ///< after what it puts packets into
    std::unique_ptr<live::Receiver> midi_receiver_;
    std::unique_ptr<live::MidiPort> midi_port_;
    SaidOnce words_;
};

} // namespace tidemark::cli
