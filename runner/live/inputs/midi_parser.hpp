// Bytes of MIDI 1.0, as a device sends them, as the moves of its controllers; all else is passed over.
#pragma once

#include <compare>
#include <string_view>
#include <vector>

namespace tidemark::live {

/// A knob or a fader of a device.
struct Controller {
    int channel = 1; ///< 1 to 16
    int number = 0;  ///< 0 to 119; above are messages to the whole channel
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
    /// A message may be cut anywhere: the rest of it comes with the next call.
    std::vector<ControlChange> parse(std::string_view bytes);

private:
    int status_ = 0; ///< of the message under way; it holds for the next ones, too ("running status")
    int first_ = -1; ///< data byte of it; none yet: -1
};

} // namespace tidemark::live
