// Converts file paths to URIs and back (RFC 3986, RFC 8089).
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tidemark {

/// Returns `file:///a/b%20c.glsl` for an absolute path, `b%20c.glsl` for a relative one.
std::string uri_reference(const std::filesystem::path& path);

/// Returns the path that a `file:` URI names on this machine; nullopt for another scheme, another machine, a
/// damaged escape or a NUL.
std::optional<std::filesystem::path> path_of_uri(std::string_view uri);

} // namespace tidemark
