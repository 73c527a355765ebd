#include "base/hash.hpp"

#include <sha2.h>
#include <sys/types.h> // libmd's header uses its types without including it

namespace tidemark {

struct Sha256::State {
    SHA2_CTX context;
};

Sha256::Sha256() : state_(std::make_unique<State>()) {
    SHA256Init(&state_->context);
}

Sha256::~Sha256() = default;

void Sha256::add(std::span<const std::byte> bytes) {
    SHA256Update(&state_->context, reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
}

std::string Sha256::digits() {
    char digits[SHA256_DIGEST_STRING_LENGTH];
    SHA256End(&state_->context, digits);
    return digits;
}

std::string sha256(std::span<const std::byte> bytes) {
    Sha256 hash;
    hash.add(bytes);
    return hash.digits();
}

} // namespace tidemark
