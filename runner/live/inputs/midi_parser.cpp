#include "live/inputs/midi_parser.hpp"

#include <utility>

namespace tidemark::live {
namespace {

constexpr int k_status = 0x80;          ///< bytes from here on are status bytes, below are data
constexpr int k_control_change = 0xB0;  ///< to 0xBF, by channel
constexpr int k_real_time = 0xF8;       ///< real-time messages from here on may interrupt another message
constexpr int k_channel_messages = 120; ///< from here on: channel modes such as "all notes off"

} // namespace

std::vector<ControlChange> MidiParser::parse(std::string_view bytes) {
    std::vector<ControlChange> changes;
    for (const char each : bytes) {
        const int byte = static_cast<unsigned char>(each);
        if (byte >= k_real_time)
            continue;
        if (byte >= k_status) {
            status_ = byte;
            first_ = -1;
        } else if ((status_ & 0xF0) != k_control_change) {
            continue; // data of another kind of message
        } else if (first_ < 0) {
            first_ = byte;
        } else if (const int number = std::exchange(first_, -1); number < k_channel_messages) {
            changes.push_back({{(status_ & 0x0F) + 1, number}, byte});
        }
    }
    return changes;
}

} // namespace tidemark::live
