#include "sound/playback.hpp"

#include <alsa/asoundlib.h>
#include <dlfcn.h>
#include <fmt/format.h>

#include <cerrno>

namespace tidemark::sound {
namespace {

/// What the device holds at most: short, so that a pause of ours is heard as one; long enough for a busy
/// machine.
constexpr unsigned k_buffer_microseconds = 200'000;

/// The functions of ALSA that we call.
struct Alsa {
    decltype(&snd_pcm_open) open = nullptr;
    decltype(&snd_pcm_close) close = nullptr;
    decltype(&snd_pcm_set_params) set_params = nullptr;
    decltype(&snd_pcm_writei) write = nullptr;
    decltype(&snd_pcm_drop) drop = nullptr;
    decltype(&snd_pcm_prepare) prepare = nullptr;
    decltype(&snd_strerror) message = nullptr;
    decltype(&snd_lib_error_set_handler) set_handler = nullptr;
};

template <class Function>
bool find(void* library, const char* name, Function& function) {
    function = reinterpret_cast<Function>(::dlsym(library, name));
    return function != nullptr;
}

/// ALSA prints by itself otherwise.
void say_nothing(const char*, int, const char*, int, const char*, ...) {}

Result<Alsa> load() {
    void* library = ::dlopen("libasound.so.2", RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE);
    Alsa alsa;
    if (library && find(library, "snd_pcm_open", alsa.open) && find(library, "snd_pcm_close", alsa.close) &&
        find(library, "snd_pcm_set_params", alsa.set_params) && find(library, "snd_pcm_writei", alsa.write) &&
        find(library, "snd_pcm_drop", alsa.drop) && find(library, "snd_pcm_prepare", alsa.prepare) &&
        find(library, "snd_strerror", alsa.message) &&
        find(library, "snd_lib_error_set_handler", alsa.set_handler)) {
        alsa.set_handler(say_nothing);
        return alsa;
    }
    const char* why = ::dlerror();
    return fail(ErrorCode::load, fmt::format("cannot load libasound: {}; install the package libasound2",
                                             why ? why : "the loader gives no reason"));
}

const Result<Alsa>& alsa() {
    static const Result<Alsa> library = load();
    return library;
}

} // namespace

struct Playback::Device {
    const Alsa& alsa;
    snd_pcm_t* pcm = nullptr;

    explicit Device(const Alsa& library) : alsa(library) {}
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;
    ~Device() {
        if (pcm)
            alsa.close(pcm);
    }
};

Playback::Playback(std::unique_ptr<Device> device) : device_(std::move(device)) {}
Playback::Playback(Playback&&) noexcept = default;
Playback& Playback::operator=(Playback&&) noexcept = default;
Playback::~Playback() = default;

Result<Playback> Playback::open(int rate) {
    const auto& library = alsa();
    if (!library)
        return fail(library.error());
    auto device = std::make_unique<Device>(*library);
    int error = library->open(&device->pcm, "default", SND_PCM_STREAM_PLAYBACK, SND_PCM_NONBLOCK);
    if (error == 0)
        error = library->set_params(device->pcm, SND_PCM_FORMAT_S16, SND_PCM_ACCESS_RW_INTERLEAVED, 2,
                                    unsigned(rate), 1, k_buffer_microseconds);
    if (error < 0)
        return fail(ErrorCode::load,
                    fmt::format("there is no sound device (ALSA says: {})", library->message(error)));
    return Playback(std::move(device));
}

std::optional<size_t> Playback::write(std::span<const int16_t> samples) {
    const snd_pcm_sframes_t taken = device_->alsa.write(device_->pcm, samples.data(), samples.size() / 2);
    if (taken >= 0)
        return size_t(taken);
    if (taken == -EAGAIN)
        return 0;
    device_->alsa.prepare(device_->pcm);
    return std::nullopt;
}

void Playback::silence() {
    device_->alsa.drop(device_->pcm);
    device_->alsa.prepare(device_->pcm);
}

} // namespace tidemark::sound
