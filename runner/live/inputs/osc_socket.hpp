// The UDP port that OSC messages come in at.
#pragma once

#include "base/result.hpp"

#include <string>
#include <string_view>

namespace tidemark::live {

/// `9000` is a port of this machine that no other machine reaches; `0.0.0.0:9000`, `studio.local:9000` or
/// `[::]:9000` names the address to listen at.
struct OscAddress {
    std::string host;
    std::string port;
    bool operator==(const OscAddress&) const = default;
};

/// Port 0 is any that is free. ErrorCode::usage says how to write one.
Result<OscAddress> parse_osc_address(std::string_view text);

/// A descriptor that reads do not wait for, and where it listens, as it can be sent to.
struct OscSocket {
    int descriptor = -1; ///< its taker closes it
    std::string address;
};

/// ErrorCode::load says why there is none: another program has the port, say.
Result<OscSocket> open_osc_socket(const OscAddress& address);

} // namespace tidemark::live
