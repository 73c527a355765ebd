// Fingerprints of bytes.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace tidemark {

/// SHA-256 as 64 lower-case hexadecimal digits.
std::string sha256(std::span<const std::byte> bytes);

} // namespace tidemark
