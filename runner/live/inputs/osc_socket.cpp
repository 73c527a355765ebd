#include "live/inputs/osc_socket.hpp"

#include "base/descriptor.hpp"

#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>

namespace tidemark::live {
namespace {

constexpr std::string_view k_loopback = "127.0.0.1";

bool is_port(std::string_view text) {
    unsigned port = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
    return error == std::errc{} && end == text.data() + text.size() && port <= 65535;
}

using Found = std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)>;

tl::unexpected<Error> refuse(const OscAddress& address, const char* why) {
    return fail(ErrorCode::load,
                fmt::format("cannot listen for OSC at {}:{}: {}", address.host, address.port, why));
}

/// Returns the numeric address and port of the socket, which the system chose if port 0 was requested; "?" on
/// failure.
std::string bound_address(int descriptor) {
    sockaddr_storage bound{};
    socklen_t size = sizeof bound;
    std::array<char, NI_MAXHOST> host{};
    std::array<char, NI_MAXSERV> port{};
    auto* address = reinterpret_cast<sockaddr*>(&bound);
    if (::getsockname(descriptor, address, &size) != 0 ||
        ::getnameinfo(address, size, host.data(), host.size(), port.data(), port.size(),
                      NI_NUMERICHOST | NI_NUMERICSERV) != 0)
        return "?";
    return fmt::format("{}:{}", host.data(), port.data());
}

} // namespace

Result<OscAddress> parse_osc_address(std::string_view text) {
    const size_t colon = text.rfind(':');
    const std::string_view port = colon == text.npos ? text : text.substr(colon + 1);
    std::string_view host = colon == text.npos ? k_loopback : text.substr(0, colon);
    if (host.starts_with('[') && host.ends_with(']'))
        host = host.substr(1, host.size() - 2);
    if (host.empty() || !is_port(port))
        return fail(
            ErrorCode::usage,
            fmt::format("--osc {}: give a port, as in --osc 9000, or an address to listen at with it, "
                        "as in --osc 0.0.0.0:9000",
                        text));
    return OscAddress{std::string(host), std::string(port)};
}

Result<OscSocket> open_osc_socket(const OscAddress& address) {
    addrinfo wanted{};
    wanted.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
    wanted.ai_socktype = SOCK_DGRAM;
    addrinfo* first = nullptr;
    if (const int error = ::getaddrinfo(address.host.c_str(), address.port.c_str(), &wanted, &first))
        return refuse(address, ::gai_strerror(error));
    const Found found(first, ::freeaddrinfo);
    Descriptor socket(::socket(found->ai_family, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    if (socket.get() < 0 || ::bind(socket.get(), found->ai_addr, found->ai_addrlen) != 0)
        return refuse(address, std::strerror(errno));
    std::string bound = bound_address(socket.get());
    return OscSocket{socket.release(), std::move(bound)};
}

} // namespace tidemark::live
