#include "window/osc.hpp"

#include "base/dynamic_library.hpp"
#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <lo/lo_lowlevel.h>
#include <netdb.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <type_traits>

namespace tidemark::window {
namespace {

constexpr std::string_view k_loopback = "127.0.0.1";

bool is_port(std::string_view text) {
    return number_from<uint16_t>(text).has_value();
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

constexpr std::string_view k_bundle("#bundle\0", 8);
constexpr size_t k_time_tag = 8;     ///< bytes
constexpr size_t k_element_size = 4; ///< bytes

/// The liblo functions that are used.
struct OscLibrary {
    decltype(&lo_message_deserialise) deserialise = nullptr;
    decltype(&lo_message_get_types) types = nullptr;
    decltype(&lo_message_get_argc) count = nullptr;
    decltype(&lo_message_get_argv) arguments = nullptr;
    decltype(&lo_message_free) free = nullptr;
};

Result<OscLibrary> load_liblo() {
    OscLibrary functions;
    SharedLibrary library("liblo.so.7");
    library.find("lo_message_deserialise", functions.deserialise)
        .find("lo_message_get_types", functions.types)
        .find("lo_message_get_argc", functions.count)
        .find("lo_message_get_argv", functions.arguments)
        .find("lo_message_free", functions.free);
    TRY(library.complete("liblo, which reads OSC", "liblo7"));
    return functions;
}

const Result<OscLibrary>& osc_library() {
    static const Result<OscLibrary> library = load_liblo();
    return library;
}

tl::unexpected<Error> refuse() {
    return fail(ErrorCode::load, "a packet that is not OSC");
}

/// Returns the shortest decimal number that rounds to that float.
double shortest(float number) {
    const std::string text = fmt::format("{}", number);
    double exact = number;
    std::from_chars(text.data(), text.data() + text.size(), exact);
    return exact;
}

/// Reads a number by memcpy: OSC and liblo align to four bytes, but a lo_arg needs eight.
template <class Number>
Number read_as(const void* argument) {
    Number number;
    std::memcpy(&number, argument, sizeof number);
    return number;
}

std::optional<OscArgument> argument_of(char type, const void* argument) {
    switch (type) {
    case 'i': return double(read_as<int32_t>(argument));
    case 'h': return double(read_as<int64_t>(argument));
    case 'f': return shortest(read_as<float>(argument));
    case 'd': return read_as<double>(argument);
    case 'T': return 1.0;
    case 'F': return 0.0;
    case 's':
    case 'S': return std::string(static_cast<const char*>(argument));
    default: return std::nullopt;
    }
}

Result<OscMessage> parse_message(const OscLibrary& liblo, std::string_view packet) {
    std::string bytes(packet); // liblo needs a writable copy
    int error = 0;
    // lo_message is void* up to liblo 0.31 and a pointer to a struct since 0.32.
    const std::unique_ptr<std::remove_pointer_t<lo_message>, decltype(liblo.free)> message(
        liblo.deserialise(bytes.data(), bytes.size(), &error), liblo.free);
    if (!message)
        return refuse();
    OscMessage read{bytes.substr(0, bytes.find('\0'))}; // the packet begins with the address
    const std::string_view types = liblo.types(message.get());
    for (int i = 0; i < liblo.count(message.get()); ++i) {
        auto argument = argument_of(types[size_t(i)], liblo.arguments(message.get())[i]);
        if (!argument)
            return fail(ErrorCode::load, fmt::format("'{}' has an argument of type '{}': give numbers",
                                                     read.address, types[size_t(i)]));
        read.arguments.push_back(*std::move(argument));
    }
    return read;
}

/// Removes the first element of a bundle and returns it; nothing where its size is not valid.
std::optional<std::string_view> take_element(std::string_view& rest) {
    if (rest.size() < k_element_size)
        return std::nullopt;
    size_t size = 0;
    for (const char byte : rest.substr(0, k_element_size))
        size = size << 8 | static_cast<unsigned char>(byte);
    rest.remove_prefix(k_element_size);
    if (size == 0 || size > rest.size())
        return std::nullopt;
    const std::string_view element = rest.substr(0, size);
    rest.remove_prefix(size);
    return element;
}

Result<void> parse_into(std::vector<OscMessage>& messages, const OscLibrary& liblo, std::string_view packet) {
    if (!packet.starts_with(k_bundle)) {
        messages.push_back(TRY(parse_message(liblo, packet)));
        return {};
    }
    if (packet.size() < k_bundle.size() + k_time_tag)
        return refuse();
    std::string_view rest = packet.substr(k_bundle.size() + k_time_tag);
    while (!rest.empty()) {
        const auto element = take_element(rest);
        if (!element)
            return refuse();
        TRY(parse_into(messages, liblo, *element));
    }
    return {};
}

constexpr std::string_view k_knob = "/knob/";

template <class... Words>
tl::unexpected<Error> refuse(fmt::format_string<Words...> form, Words&&... words) {
    return fail(ErrorCode::usage, "OSC: " + fmt::format(form, std::forward<Words>(words)...));
}

/// Returns the number in a message with exactly one argument.
std::optional<double> number_of(const OscMessage& message) {
    if (message.arguments.size() != 1)
        return std::nullopt;
    const auto* number = std::get_if<double>(message.arguments.data());
    return number ? std::optional(*number) : std::nullopt;
}

std::optional<size_t> component_of(std::string_view name, const scene::Knob& knob) {
    constexpr std::string_view k_letters[] = {"xyzw", "rgba"};
    for (const std::string_view letters : k_letters)
        if (const size_t at = letters.find(name); name.size() == 1 && at < size_t(info(knob.type).components))
            return at;
    return std::nullopt;
}

/// Returns a number as the knob takes it: rounded for a whole-number knob, as faders send fractions.
double number_for(const scene::Knob& knob, double number) {
    return info(knob.type).whole ? std::round(number) : number;
}

/// Returns the arguments as the text of one value, as --set takes it.
std::string text_for(const scene::Knob& knob, std::span<const OscArgument> arguments) {
    std::vector<std::string> words;
    for (const OscArgument& argument : arguments) {
        const auto* number = std::get_if<double>(&argument);
        words.push_back(number ? fmt::format("{}", number_for(knob, *number))
                               : std::get<std::string>(argument));
    }
    return fmt::format("{}", fmt::join(words, ","));
}

/// Returns the arguments as one value if they are one to four numbers.
std::optional<scene::GivenValue> numbers_for(const scene::Knob& knob,
                                             std::span<const OscArgument> arguments) {
    scene::GivenValue given{int(arguments.size())};
    if (arguments.empty() || arguments.size() > given.numbers.size())
        return std::nullopt;
    for (size_t i = 0; i < arguments.size(); ++i) {
        const auto* number = std::get_if<double>(&arguments[i]);
        if (!number)
            return std::nullopt;
        given.numbers[i] = number_for(knob, *number);
    }
    return given;
}

/// Returns the knob's value, with the same rules as for `--set`.
Result<scene::KnobValue> value_of(const scene::Knob& knob, std::span<const OscArgument> arguments) {
    const auto given = numbers_for(knob, arguments);
    auto value = given ? value_for(knob, *given) : parse_knob_value(knob, text_for(knob, arguments));
    if (!value)
        return refuse("{}", value.error().message);
    return value;
}

Result<overlay::Command> turn_component(const scene::Knob& knob, std::string_view name,
                                        const OscMessage& message) {
    const auto component = component_of(name, knob);
    if (!component)
        return refuse("{} ({}) has no component '{}'", knob.name, info(knob.type).directive_name, name);
    if (!number_of(message))
        return refuse("'{}' takes one number", message.address);
    scene::KnobValue value = knob.value;
    value[*component] = TRY(value_of(knob, message.arguments))[*component];
    return overlay::TurnKnob{knob.name, value};
}

Result<overlay::Command> turn(const OscMessage& message, std::span<const scene::Knob> knobs) {
    const std::string_view rest = std::string_view(message.address).substr(k_knob.size());
    const size_t slash = rest.find('/');
    const std::string_view name = rest.substr(0, slash);
    const auto knob = std::ranges::find(knobs, name, &scene::Knob::name);
    if (knob == knobs.end()) {
        std::vector<scene::Knob> named(knobs.begin(), knobs.end());
        return refuse("{}", find_knob(named, name).error().message);
    }
    if (slash != rest.npos)
        return turn_component(*knob, rest.substr(slash + 1), message);
    const auto value = TRY(value_of(*knob, message.arguments));
    return overlay::TurnKnob{knob->name, value};
}

Result<overlay::Command> seek(const OscMessage& message) {
    const auto seconds = number_of(message);
    if (!seconds || !(*seconds >= 0))
        return refuse("/time takes one number of seconds, 0 or more");
    return overlay::Seek{*seconds};
}

Result<overlay::Command> play(const OscMessage& message) {
    const auto number = message.arguments.empty() ? std::optional(1.0) : number_of(message);
    if (!number)
        return refuse("/play takes 1 or 0");
    return overlay::SetPlaying{*number != 0};
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

Result<std::vector<OscMessage>> parse_osc(std::string_view packet) {
    const auto& liblo = osc_library();
    if (!liblo)
        return fail(liblo.error());
    std::vector<OscMessage> messages;
    TRY(parse_into(messages, *liblo, packet));
    return messages;
}

Result<overlay::Command> osc_command(const OscMessage& message, std::span<const scene::Knob> knobs) {
    if (message.address.starts_with(k_knob))
        return turn(message, knobs);
    if (message.address == "/time")
        return seek(message);
    if (message.address == "/play")
        return play(message);
    return refuse("unknown address '{}': send /knob/NAME, /time or /play", message.address);
}

} // namespace tidemark::window
