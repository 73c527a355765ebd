#include "window/midi.hpp"

#include "base/dynamic_library.hpp"
#include "base/error.hpp"
#include "host/overlay_fields.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <rtmidi_c.h>
#include <sys/eventfd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <iterator>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace tidemark::window {

void Inbox::put(std::string_view packet) {
    bool first = false;
    {
        const std::lock_guard lock(mutex_);
        first = packets_.empty();
        packets_.emplace_back(packet);
        bytes_ += packet.size();
        while (packets_.size() > 1 && (packets_.size() > k_most_packets || bytes_ > k_most_bytes)) {
            bytes_ -= packets_.front().size();
            packets_.pop_front();
        }
    }
    if (first)
        wake_();
}

bool Inbox::empty() {
    const std::lock_guard lock(mutex_);
    return packets_.empty();
}

std::vector<std::string> Inbox::take() {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> taken(std::make_move_iterator(packets_.begin()),
                                   std::make_move_iterator(packets_.end()));
    packets_.clear();
    bytes_ = 0;
    return taken;
}

namespace {

/// The largest UDP packet, in bytes.
constexpr size_t k_longest_packet = 1 << 16;

/// Returns whether the descriptor is a socket: an empty read is then an empty packet, not the end of a file.
bool is_socket(int descriptor) {
    struct stat status {};
    return ::fstat(descriptor, &status) == 0 && S_ISSOCK(status.st_mode);
}

} // namespace

Receiver::Receiver(int from, Inbox& into)
    : from_(from), stop_(::eventfd(0, EFD_CLOEXEC)), thread_([this, &into] { receive(into); }) {}

Receiver::~Receiver() {
    (void)::eventfd_write(stop_.get(), 1);
    thread_.join();
}

void Receiver::receive(Inbox& into) const {
    std::string bytes(k_longest_packet, '\0');
    std::array<pollfd, 2> waited{{{from_.get(), POLLIN, 0}, {stop_.get(), POLLIN, 0}}};
    while (true) {
        if (::poll(waited.data(), waited.size(), -1) < 0 && errno != EINTR)
            return;
        if (waited[1].revents != 0)
            return;
        const ssize_t size = ::read(from_.get(), bytes.data(), bytes.size());
        if (size > 0)
            into.put({bytes.data(), size_t(size)});
        else if (size < 0 ? errno != EAGAIN && errno != EINTR : !is_socket(from_.get()))
            return;
    }
}

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

namespace {

constexpr const char* k_sequencer = "/dev/snd/seq";
constexpr unsigned k_queue = 1; ///< messages; not used, since a callback receives them

constexpr int k_status = 0x80;          ///< bytes from here on are status bytes, below are data
constexpr int k_control_change = 0xB0;  ///< to 0xBF, by channel
constexpr int k_real_time = 0xF8;       ///< real-time messages from here on may interrupt another message
constexpr int k_channel_messages = 120; ///< from here on: channel modes such as "all notes off"

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
        return cannot_listen("no port is called '{}'; there {} {}", name, ports.empty() ? "are" : "is",
                             ports.empty() ? "none" : fmt::format("{}", fmt::join(ports, ", ")));
    device->rtmidi.set_callback(device->in, put, &into);
    device->rtmidi.open_port(device->in, unsigned(found - ports.begin()), "knobs");
    if (!device->in->ok)
        return cannot_listen("'{}' cannot be opened", *found);
    return std::unique_ptr<MidiPort>(new MidiPort(std::move(device)));
}

std::vector<ControlChange> MidiParser::parse(std::string_view bytes) {
    std::vector<ControlChange> changes;
    for (const char each : bytes) {
        const int byte = static_cast<unsigned char>(each);
        if (byte >= k_real_time)
            continue;
        if (byte >= k_status) {
            status_ = byte;
            first_ = -1;
        } else if ((status_ & 0xF0) != k_control_change) {
            continue; // data of another kind of message
        } else if (first_ < 0) {
            first_ = byte;
        } else if (const int number = std::exchange(first_, -1); number < k_channel_messages) {
            changes.push_back({{(status_ & 0x0F) + 1, number}, byte});
        }
    }
    return changes;
}

std::string to_string(const Controller& controller) {
    return controller.channel == 1
               ? fmt::format("controller {}", controller.number)
               : fmt::format("controller {} of channel {}", controller.number, controller.channel);
}

std::string to_string(const KnobPart& part, const scene::Knob& knob) {
    if (info(knob.type).components == 1)
        return part.knob;
    const std::string_view letters = knob.type == scene::KnobType::color3 ? "rgba" : "xyzw";
    return fmt::format("{}.{}", part.knob, letters[part.component]);
}

double value_at(const scene::Knob& knob, size_t component, int midi_value) {
    const bool whole = info(knob.type).whole;
    double low = 0;
    double high = whole ? k_highest_midi_value : 1;
    if (knob.range) {
        low = knob.range->low[component];
        high = knob.range->high[component];
    }
    const double share = double(midi_value) / k_highest_midi_value;
    const double value = overlay::in_steps(knob, component, std::lerp(low, high, share));
    return whole ? std::round(value) : value;
}

void ControllerMap::learn(const KnobPart& part) {
    learning_ = learning_ == part ? std::nullopt : std::optional(part);
}

void ControllerMap::forget(const KnobPart& part) {
    std::erase_if(bindings_, [&](const Binding& binding) { return binding.part == part; });
    if (learning_ == part)
        learning_.reset();
}

std::optional<Controller> ControllerMap::controller_of(const KnobPart& part) const {
    const auto found = std::ranges::find(bindings_, part, &Binding::part);
    return found == bindings_.end() ? std::nullopt : std::optional(found->controller);
}

std::optional<overlay::TurnKnob> ControllerMap::turn(const ControlChange& change,
                                                     std::span<const scene::Knob> knobs) {
    if (const auto part = std::exchange(learning_, std::nullopt)) {
        std::erase_if(bindings_, [&](const Binding& binding) {
            return binding.part == *part || binding.controller == change.controller;
        });
        bindings_.push_back({change.controller, *part});
    }
    const auto bound = std::ranges::find(bindings_, change.controller, &Binding::controller);
    if (bound == bindings_.end())
        return std::nullopt;
    const auto knob = std::ranges::find(knobs, bound->part.knob, &scene::Knob::name);
    const size_t component = bound->part.component;
    if (knob == knobs.end() || component >= size_t(info(knob->type).components))
        return std::nullopt; // the scene was edited
    scene::KnobValue value = knob->value;
    value[component] = value_at(*knob, component, change.value);
    return overlay::TurnKnob{knob->name, value};
}

} // namespace tidemark::window
