// An input port of ALSA's sequencer, through librtmidi, which is loaded by `open`.
#pragma once

#include "base/result.hpp"
#include "live/inputs/inbox.hpp"

#include <memory>
#include <string_view>

namespace tidemark::live {

class MidiPort {
public:
    /// Opens the first port whose name contains `name`. A thread of librtmidi puts its messages into `into`.
    /// ErrorCode::load names the available ports, or the reason why there are none.
    static Result<std::unique_ptr<MidiPort>> open(std::string_view name, Inbox& into);
    ~MidiPort();
    MidiPort(const MidiPort&) = delete;
    MidiPort& operator=(const MidiPort&) = delete;

private:
    struct Device;
    explicit MidiPort(std::unique_ptr<Device> device);

    std::unique_ptr<Device> device_;
};

} // namespace tidemark::live
