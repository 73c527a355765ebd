// The interface of the program and the web server's plug-in: viewers' messages come in, pictures and texts
// for them go out. The plug-in handles HTTP, WebSocket (RFC 6455) and JPEG, but not scenes. Both are
// built together; a plug-in with another version is refused.
#pragma once

#include "base/error.hpp"
#include "base/extent.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::web {

struct Message {
    std::string bytes;
    bool binary = false; ///< otherwise text, UTF-8
};
using SharedMessage = std::shared_ptr<const Message>;

/// Number of a connection; never reused.
using ViewerId = uint64_t;

/// Receives the viewers' events. Called on the server's thread.
class Guests {
public:
    virtual ~Guests() = default;

    /// Returns whether there is room for one more viewer.
    virtual bool came(ViewerId viewer) = 0;
    /// Handles a text message; if it fails, the connection is closed with the error's message.
    virtual Result<void> said(ViewerId viewer, std::string_view message) = 0;
    virtual void left(ViewerId viewer) = 0;
};

struct ServerSettings {
    std::string host;  ///< a name or an address of this machine
    uint16_t port = 0; ///< 0: any free port
    std::string token;
    std::string page;                     ///< HTML
    std::vector<std::string> ancestors{}; ///< pages that may frame it, by check_ancestor; empty: none
    std::vector<std::string> origins{};   ///< of forwarded addresses, by check_origin
};

/// Listens while it lives, or until it is stopped.
class Server {
public:
    virtual ~Server() = default;

    /// Starts to accept viewers; to be called once. `guests` must outlive the server.
    virtual void start(Guests& guests) = 0;
    /// Ends all connections; no more events are reported.
    virtual void stop() = 0;
    /// Thread-safe. A viewer that does not read its messages is disconnected.
    virtual void send(ViewerId viewer, SharedMessage message) = 0;

    /// Returns `127.0.0.1:8080` or `[::1]:8080`; if it listens on every address, the machine's name and the
    /// port.
    virtual std::string place() const = 0;
    virtual bool is_loopback() const = 0;
};

struct ServePlugIn {
    unsigned version;
    /// Fails (ErrorCode::usage) if it cannot listen there.
    Result<std::unique_ptr<Server>> (*open)(const ServerSettings& settings);
    /// Returns a JPEG file of RGBA pixels, 8 bits per channel, bottom row first; alpha is ignored. `quality`
    /// is 1 to 100. Not thread-safe. Empty if the library fails.
    std::string (*encode)(Extent extent, std::span<const std::byte> rgba, int quality);
};

inline constexpr unsigned k_serve_version = 4;
inline constexpr const char* k_serve_entry = "tidemark_serve";

} // namespace tidemark::web
