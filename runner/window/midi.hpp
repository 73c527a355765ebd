// A queue of received packets, of OSC or MIDI, from the receiving threads to the thread that owns the window;
// and MIDI itself.
#pragma once

#include "base/error.hpp"
#include "base/file.hpp"
#include "host/overlay_model.hpp"

#include <compare>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace tidemark::window {

class Inbox {
public:
    /// `wake` is called on the thread of `put` when a packet arrives in the empty queue.
    explicit Inbox(std::function<void()> wake) : wake_(std::move(wake)) {}

    /// Adds one whole packet. Drops the oldest ones beyond 4,096 packets or 1 MiB.
    void put(std::string_view packet);

    bool empty();
    /// Removes all packets and returns them in the order of arrival.
    std::vector<std::string> take();

private:
    static constexpr size_t k_most_packets = 4096;
    static constexpr size_t k_most_bytes = 1 << 20; ///< parsed in about 20 ms

    std::function<void()> wake_;
    std::mutex mutex_;
    std::deque<std::string> packets_; ///< guarded by mutex_
    size_t bytes_ = 0;                ///< total size of packets_, guarded by mutex_
};

// A thread that reads packets from a descriptor (a socket, a pipe, a device) and puts them into an Inbox.

class Receiver {
public:
    /// Takes ownership of the descriptor. Each read is one packet. The thread ends at the end of the input.
    Receiver(int from, Inbox& into);
    ~Receiver();
    Receiver(const Receiver&) = delete;
    Receiver& operator=(const Receiver&) = delete;

private:
    void receive(Inbox& into) const;

    Descriptor from_;
    Descriptor stop_; ///< an eventfd that becomes readable when the thread must end
    std::thread thread_;
};

// A source of MIDI bytes with a file name: a device such as `/dev/snd/midiC1D0`, a pipe, a recording.

/// Opens it for non-blocking reads. Returns a descriptor that the caller must close. A pipe stays open when
/// its writers close it. Fails with ErrorCode::load.
Result<int> open_midi_device(const std::filesystem::path& file);

// An input port of ALSA's sequencer, through librtmidi, which is loaded by `open`.

class MidiPort {
public:
    /// Opens the first port whose name contains `name`. A thread of librtmidi puts its messages into `into`.
    /// ErrorCode::load names the available ports, or the reason why there are none.
    static Result<std::unique_ptr<MidiPort>> open(std::string_view name, Inbox& into);
    ~MidiPort();
    MidiPort(const MidiPort&) = delete;
    MidiPort& operator=(const MidiPort&) = delete;

private:
    struct Device;
    explicit MidiPort(std::unique_ptr<Device> device);

    std::unique_ptr<Device> device_;
};

// Parses MIDI 1.0 bytes into control changes and ignores all other messages.

/// A knob or fader of a MIDI device.
struct Controller {
    int channel = 1; ///< 1 to 16
    int number = 0;  ///< 0 to 119; the numbers above are channel mode messages
    auto operator<=>(const Controller&) const = default;
};

inline constexpr int k_highest_midi_value = 127;

struct ControlChange {
    Controller controller;
    int value = 0; ///< 0 to 127
    bool operator==(const ControlChange&) const = default;
};

class MidiParser {
public:
    /// Parses the next bytes. A message may be split between calls.
    std::vector<ControlChange> parse(std::string_view bytes);

private:
    int status_ = 0; ///< of this message, and of later ones without a status ("running status")
    int first_ = -1; ///< first data byte of the message; -1: not received yet
};

// Bindings of MIDI controllers to knobs, learned by moving a controller. The owner of the map keeps them.

/// One component of a knob.
struct KnobPart {
    std::string knob;
    size_t component = 0;
    bool operator==(const KnobPart&) const = default;
};

struct Binding {
    Controller controller;
    KnobPart part;
    bool operator==(const Binding&) const = default;
};

/// Formats a controller: `controller 7`, `controller 7 of channel 2`.
std::string to_string(const Controller& controller);
/// Formats a component: `height`, `tint.g`.
std::string to_string(const KnobPart& part, const scene::Knob& knob);

/// Returns the value of a component for a controller's position: linear over the knob's range, rounded to its
/// steps. Without a range it is 0 to 1, or 0 to 127 for whole numbers.
double value_at(const scene::Knob& knob, size_t component, int midi_value);

class ControllerMap {
public:
    ControllerMap() = default;
    explicit ControllerMap(std::vector<Binding> bindings) : bindings_(std::move(bindings)) {}

    /// Binds the next controller that moves to that part, replacing the earlier bindings of both. A second
    /// call for the same part cancels.
    void learn(const KnobPart& part);
    void forget(const KnobPart& part);
    /// Returns the part that waits for a controller.
    const std::optional<KnobPart>& learning() const { return learning_; }
    /// Returns the controller that is bound to a part.
    std::optional<Controller> controller_of(const KnobPart& part) const;
    const std::vector<Binding>& bindings() const { return bindings_; }

    /// Completes `learn` if it is pending, then returns the change of the bound knob. Returns nothing where
    /// the controller is not bound or the scene has no such part.
    std::optional<overlay::TurnKnob> turn(const ControlChange& change, std::span<const scene::Knob> knobs);

private:
    std::vector<Binding> bindings_; ///< each controller and each part at most once
    std::optional<KnobPart> learning_;
};

} // namespace tidemark::window
