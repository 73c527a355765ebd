// A buffer of 32-bit words that instrumented texts write (glsl/instrument/watch.hpp,
// glsl/instrument/domains.hpp). A context must be current.
#pragma once

#include "gl/handle.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tidemark::lab {

class ShaderWords {
public:
    /// Creates `count` zeros and binds them for the instrumented texts.
    explicit ShaderWords(size_t count);

    /// Returns what the draws so far have written.
    std::vector<uint32_t> read() const;

private:
    gl::BufferHandle buffer_;
    size_t count_;
};

} // namespace tidemark::lab
