#include "sound/sound_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

namespace tidemark::sound {
namespace {

template <class Function>
bool find(void* library, const char* name, Function& function) {
    function = reinterpret_cast<Function>(::dlsym(library, name));
    return function != nullptr;
}

Result<SoundLibrary> load() {
    void* handle = ::dlopen("libsndfile.so.1", RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE);
    SoundLibrary library;
    if (handle && find(handle, "sf_open_virtual", library.open_virtual) &&
        find(handle, "sf_readf_float", library.read_frames) && find(handle, "sf_strerror", library.message) &&
        find(handle, "sf_close", library.close))
        return library;
    const char* why = ::dlerror();
    return fail(ErrorCode::load,
                fmt::format("cannot load libsndfile, which reads sound: {}; install the package libsndfile1",
                            why ? why : "the loader gives no reason"));
}

} // namespace

const Result<SoundLibrary>& sound_library() {
    static const Result<SoundLibrary> library = load();
    return library;
}

} // namespace tidemark::sound
