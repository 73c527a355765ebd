// A port of ALSA's sequencer that MIDI comes in at, by librtmidi, which is loaded then.
#pragma once

#include "base/result.hpp"
#include "live/inputs/inbox.hpp"

#include <memory>
#include <string_view>

namespace tidemark::live {

class MidiPort {
public:
    /// The first port whose name has that in it; its messages are put into the inbox by a thread of the
    /// library. ErrorCode::load names the ports that there are, or says why there are none.
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
