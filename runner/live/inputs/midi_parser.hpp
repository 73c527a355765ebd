// Parses MIDI 1.0 bytes into control changes and ignores all other messages.
#pragma once

#include <compare>
#include <string_view>
#include <vector>

namespace tidemark::live {

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

} // namespace tidemark::live
