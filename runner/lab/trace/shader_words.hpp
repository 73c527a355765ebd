// A buffer of words that a shader writes into (glsl/instrument/watch.hpp, glsl/instrument/domains.hpp). A
// context must be current.
#pragma once

#include "gl/handle.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tidemark::lab {

class ShaderWords {
public:
    /// Zeros, bound where the watched texts look for them.
    explicit ShaderWords(size_t count);

    /// What the draws up to now have written.
    std::vector<uint32_t> read() const;

private:
    gl::BufferHandle buffer_;
    size_t count_;
};

} // namespace tidemark::lab
