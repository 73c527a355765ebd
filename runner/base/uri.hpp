// Names of files as URIs and back (RFC 3986, RFC 8089).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tidemark {

/// `file:///a/b%20c.glsl` of an absolute path, `b%20c.glsl` of a relative one.
std::string uri_reference(const std::filesystem::path& path);

/// The path that a `file:` URI names on this machine; nothing for another scheme, another machine, a damaged
/// escape or a NUL.
std::optional<std::filesystem::path> path_of_uri(std::string_view uri);

} // namespace tidemark
