// Parses OSC 1.0 packets from the network into messages. liblo does the work; it is loaded with the first
// packet.
#pragma once

#include "base/result.hpp"

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tidemark::live {

/// A float becomes the shortest decimal number that rounds to it: 0.1, not 0.10000000149.
using OscArgument = std::variant<double, std::string>;

struct OscMessage {
    std::string address; ///< `/knob/height`
    std::vector<OscArgument> arguments{};
    bool operator==(const OscMessage&) const = default;
};

/// Returns the messages of a packet; those of a bundle in their order, ignoring its time tag, since all apply
/// to the next frame. Fails as a whole where the packet is not OSC, or an argument is not a number, a boolean
/// or a string.
Result<std::vector<OscMessage>> parse_osc(std::string_view packet);

} // namespace tidemark::live
