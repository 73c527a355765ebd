// OSC input: the socket, the packets, and the commands they stand for.
//
// The UDP socket that receives OSC messages.
#pragma once

#include "base/error.hpp"
#include "host/overlay_model.hpp"

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tidemark::window {

/// The address to listen at. `9000` is a port that only this machine reaches; `0.0.0.0:9000`,
/// `studio.local:9000` and `[::]:9000` name an address, too.
struct OscAddress {
    std::string host;
    std::string port;
    bool operator==(const OscAddress&) const = default;
};

/// Parses an address. Port 0 requests any free port. ErrorCode::usage contains an example.
Result<OscAddress> parse_osc_address(std::string_view text);

/// A non-blocking UDP socket and the address that clients can send to.
struct OscSocket {
    int descriptor = -1; ///< the caller must close it
    std::string address;
};

/// Opens the socket. ErrorCode::load gives the reason, for example that another program uses the port.
Result<OscSocket> open_osc_socket(const OscAddress& address);

// Parses OSC 1.0 packets from the network into messages. liblo does the work; it is loaded with the first
// packet.

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

// Translates OSC messages to commands for the window.

/// Returns the command for a message. `knobs` have their current values.
///
///     /knob/NAME v            in the knob's own units, one number for all its components or one for each;
///                             a text is read as --set reads it
///     /knob/NAME/g v          one component: x y z w, r g b a
///     /time SECONDS           iTime
///     /play 0                 pauses; 1, or no argument, resumes
///
/// Fails with ErrorCode::usage and a one-line message.
Result<overlay::Command> osc_command(const OscMessage& message, std::span<const scene::Knob> knobs);

} // namespace tidemark::window
