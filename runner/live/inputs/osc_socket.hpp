// The UDP socket that receives OSC messages.
#pragma once

#include "base/result.hpp"

#include <string>
#include <string_view>

namespace tidemark::live {

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

} // namespace tidemark::live
