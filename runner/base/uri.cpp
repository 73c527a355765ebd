#include "base/uri.hpp"

#include <fmt/format.h>

#include <charconv>

namespace tidemark {
namespace {

/// Returns whether a character needs no escape: RFC 3986's unreserved characters and the slash.
bool stands_for_itself(unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '.' || c == '_' || c == '~' || c == '/';
}

std::optional<std::string> without_escapes(std::string_view text) {
    std::string plain;
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            plain += text[i];
            continue;
        }
        unsigned byte = 0;
        const char* const digits = text.data() + i + 1;
        if (i + 2 >= text.size() || std::from_chars(digits, digits + 2, byte, 16).ptr != digits + 2 ||
            byte == 0)
            return std::nullopt;
        plain += char(byte);
        i += 2;
    }
    return plain;
}

} // namespace

std::string uri_reference(const std::filesystem::path& path) {
    std::string uri = path.is_absolute() ? "file://" : "";
    for (const char c : path.native())
        uri += stands_for_itself(static_cast<unsigned char>(c))
                   ? std::string(1, c)
                   : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    return uri;
}

std::optional<std::filesystem::path> path_of_uri(std::string_view uri) {
    constexpr std::string_view k_scheme = "file://";
    if (!uri.starts_with(k_scheme))
        return std::nullopt;
    uri.remove_prefix(k_scheme.size());
    if (uri.starts_with("localhost/"))
        uri.remove_prefix(std::string_view("localhost").size());
    if (!uri.starts_with('/') || uri.find('\0') != uri.npos)
        return std::nullopt;
    const auto plain = without_escapes(uri);
    return plain ? std::optional(std::filesystem::path(*plain).lexically_normal()) : std::nullopt;
}

} // namespace tidemark
