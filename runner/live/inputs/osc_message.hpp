// OSC 1.0 packets, as they come from the network, as messages. Reading one is liblo's part: it is loaded with
// the first packet.
#pragma once

#include "base/result.hpp"

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tidemark::live {

/// A float is the shortest decimal number that means it: 0.1, not 0.10000000149.
using OscArgument = std::variant<double, std::string>;

struct OscMessage {
    std::string address; ///< `/knob/height`
    std::vector<OscArgument> arguments{};
    bool operator==(const OscMessage&) const = default;
};

/// Those of a bundle in its order, whatever time it asks for: they are for the next frame. A packet that is
/// not OSC, or has an argument that is no number, truth or text, is an error as a whole.
Result<std::vector<OscMessage>> parse_osc(std::string_view packet);

} // namespace tidemark::live
