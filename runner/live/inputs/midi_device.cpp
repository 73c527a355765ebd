#include "live/inputs/midi_device.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <system_error>

namespace tidemark::live {

Result<int> open_midi_device(const std::filesystem::path& file) {
    // Open a pipe for writing too: then it has no end when its other writers close it.
    std::error_code ignored;
    const int access = std::filesystem::is_fifo(file, ignored) ? O_RDWR : O_RDONLY;
    const int descriptor = ::open(file.c_str(), access | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0)
        return fail(ErrorCode::load,
                    fmt::format("cannot listen to MIDI from '{}': {}", file.string(), std::strerror(errno)));
    return descriptor;
}

} // namespace tidemark::live
