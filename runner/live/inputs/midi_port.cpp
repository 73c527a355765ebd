#include "live/inputs/midi_port.hpp"

#include "base/shared_library.hpp"
#include "base/try.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <rtmidi_c.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

namespace tidemark::live {

namespace {

constexpr const char* k_sequencer = "/dev/snd/seq";
constexpr unsigned k_queue = 1; ///< messages; not used, since a callback receives them

/// The librtmidi functions that are used.
struct MidiLibrary {
    decltype(&rtmidi_in_create) create = nullptr;
    decltype(&rtmidi_in_free) free = nullptr;
    decltype(&rtmidi_get_port_count) port_count = nullptr;
    decltype(&rtmidi_get_port_name) port_name = nullptr;
    decltype(&rtmidi_open_port) open_port = nullptr;
    decltype(&rtmidi_in_set_callback) set_callback = nullptr;
};

Result<MidiLibrary> load_rtmidi() {
    MidiLibrary functions;
    SharedLibrary library("librtmidi.so." TIDEMARK_RTMIDI_NUMBER);
    library.find("rtmidi_in_create", functions.create)
        .find("rtmidi_in_free", functions.free)
        .find("rtmidi_get_port_count", functions.port_count)
        .find("rtmidi_get_port_name", functions.port_name)
        .find("rtmidi_open_port", functions.open_port)
        .find("rtmidi_in_set_callback", functions.set_callback);
    TRY(library.complete("librtmidi, which listens to MIDI", "librtmidi" TIDEMARK_RTMIDI_NUMBER));
    return functions;
}

template <class... Words>
tl::unexpected<Error> cannot_listen(fmt::format_string<Words...> form, Words&&... words) {
    return fail(ErrorCode::load,
                "cannot listen to MIDI: " + fmt::format(form, std::forward<Words>(words)...));
}

void put(double, const unsigned char* message, size_t size, void* into) {
    static_cast<Inbox*>(into)->put({reinterpret_cast<const char*>(message), size});
}

} // namespace

struct MidiPort::Device {
    MidiLibrary rtmidi;
    RtMidiInPtr in = nullptr;

    explicit Device(const MidiLibrary& library)
        : rtmidi(library), in(library.create(RTMIDI_API_LINUX_ALSA, "tidemark", k_queue)) {}
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
    ~Device() { rtmidi.free(in); }

    std::vector<std::string> ports() const {
        std::vector<std::string> names;
        for (unsigned i = 0; i < rtmidi.port_count(in); ++i) {
            int size = 0;
            rtmidi.port_name(in, i, nullptr, &size);
            std::string name(size_t(std::max(size, 1)), '\0');
            rtmidi.port_name(in, i, name.data(), &size);
            names.emplace_back(name.c_str());
        }
        return names;
    }
};

MidiPort::MidiPort(std::unique_ptr<Device> device) : device_(std::move(device)) {}
MidiPort::~MidiPort() = default;

Result<std::unique_ptr<MidiPort>> MidiPort::open(std::string_view name, Inbox& into) {
    // Check this first: librtmidi's own error gives no reason.
    if (::access(k_sequencer, R_OK | W_OK) != 0)
        return cannot_listen("ALSA's sequencer, {}: {}; give a device's file, as in --midi /dev/snd/midiC1D0",
                             k_sequencer, std::strerror(errno));
    auto device = std::make_unique<Device>(TRY(load_rtmidi()));
    if (!device->in->ok)
        return cannot_listen("ALSA's sequencer cannot be opened");
    const auto ports = device->ports();
    const auto found =
        std::ranges::find_if(ports, [&](const std::string& port) { return port.find(name) != port.npos; });
    if (found == ports.end())
        return cannot_listen("no port is called '{}': there {} {}", name, ports.empty() ? "are" : "is",
                             ports.empty() ? "none" : fmt::format("{}", fmt::join(ports, ", ")));
    device->rtmidi.set_callback(device->in, put, &into);
    device->rtmidi.open_port(device->in, unsigned(found - ports.begin()), "knobs");
    if (!device->in->ok)
        return cannot_listen("'{}' cannot be opened", *found);
    return std::unique_ptr<MidiPort>(new MidiPort(std::move(device)));
}

} // namespace tidemark::live
