#include "base/hash.hpp"

#include <sha2.h>
#include <sys/types.h> // libmd's header uses its types without including it

namespace tidemark {

std::string sha256(std::span<const std::byte> bytes) {
    char digits[SHA256_DIGEST_STRING_LENGTH];
    SHA256Data(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size(), digits);
    return digits;
}

} // namespace tidemark
