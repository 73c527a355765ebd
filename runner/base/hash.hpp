// Computes SHA-256 fingerprints.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

namespace tidemark {

/// SHA-256 of data that comes piece by piece.
class Sha256 {
public:
    Sha256();
    ~Sha256();

    void add(std::span<const std::byte> bytes);
    /// Returns 64 lower-case hexadecimal digits. To be called once, after the last piece.
    std::string digits();

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Returns the SHA-256 as 64 lower-case hexadecimal digits.
std::string sha256(std::span<const std::byte> bytes);

} // namespace tidemark
