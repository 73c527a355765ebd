#include "live/inputs/osc_message.hpp"

#include "base/shared_library.hpp"
#include "base/try.hpp"

#include <fmt/format.h>
#include <lo/lo_lowlevel.h>

#include <charconv>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <type_traits>

namespace tidemark::live {
namespace {

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

} // namespace

Result<std::vector<OscMessage>> parse_osc(std::string_view packet) {
    const auto& liblo = osc_library();
    if (!liblo)
        return fail(liblo.error());
    std::vector<OscMessage> messages;
    TRY(parse_into(messages, *liblo, packet));
    return messages;
}

} // namespace tidemark::live
