// What the program and the plug-in of the web server say to each other: messages of viewers come in, pictures
// and words for them go out. The plug-in knows HTTP, WebSocket (RFC 6455), JPEG and VP8, and nothing of
// scenes. Both are built together; the version refuses a plug-in of another build.
#pragma once

#include "base/extent.hpp"
#include "base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace tidemark::serve {

struct Message {
    std::string bytes;
    bool binary = false; ///< else text, UTF-8
};
using SharedMessage = std::shared_ptr<const Message>;

/// Of a connection; none comes twice.
using ViewerId = uint64_t;

/// Who is told of viewers. Called on the server's thread.
class Guests {
public:
    virtual ~Guests() = default;

    /// Whether there is room for one more.
    virtual bool came(ViewerId viewer) = 0;
    /// A text; where it fails the connection is closed with that message.
    virtual Result<void> said(ViewerId viewer, std::string_view message) = 0;
    virtual void left(ViewerId viewer) = 0;
};

struct ServerSettings {
    std::string host;  ///< a name or an address of this machine
    uint16_t port = 0; ///< 0: any that is free
    std::string token;
    std::string page; ///< HTML
};

/// Listens as long as it lives, or until it is told to stop.
class Server {
public:
    virtual ~Server() = default;

    /// Lets viewers in, once; `guests` must live longer.
    virtual void start(Guests& guests) = 0;
    /// Ends all connections; nobody is told of anything from here on.
    virtual void stop() = 0;
    /// From any thread. A viewer that does not read what it is sent is dropped.
    virtual void send(ViewerId viewer, SharedMessage message) = 0;

    /// `127.0.0.1:8080`, `[::1]:8080`; where it listens at every address, the machine's name and the port.
    virtual std::string place() const = 0;
    virtual bool is_loopback() const = 0;
};

/// Pictures one after the other, each as what changed since the one before.
class Film {
public:
    virtual ~Film() = default;
    /// RGBA in bytes, bottom row first, without its alpha. `key`: it is to be seen without those before; so
    /// is the first of each size. On one thread at a time. Empty where the library fails.
    virtual std::string encode(Extent extent, std::span<const std::byte> rgba, bool key) = 0;
};

struct ServePlugIn {
    unsigned version;
    /// Fails (ErrorCode::usage) where it cannot listen there.
    Result<std::unique_ptr<Server>> (*open)(const ServerSettings& settings);
    /// A JPEG file of RGBA in bytes, bottom row first, without its alpha. `quality` from 1 to 100. On one
    /// thread at a time. Empty where the library fails.
    std::string (*encode)(Extent extent, std::span<const std::byte> rgba, int quality);
    /// VP8, `quality` as above.
    std::unique_ptr<Film> (*open_film)(int quality);
};

inline constexpr unsigned k_serve_version = 2;
inline constexpr const char* k_serve_entry = "tidemark_serve";

} // namespace tidemark::serve
