// Fingerprints of bytes.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace tidemark {

/// SHA-256 of bytes that come piece by piece.
class Sha256 {
public:
    Sha256();
    ~Sha256();

    void add(std::span<const std::byte> bytes);
    /// 64 lower-case hexadecimal digits; once, after the last piece.
    std::string digits();

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// SHA-256 as 64 lower-case hexadecimal digits.
std::string sha256(std::span<const std::byte> bytes);

} // namespace tidemark
