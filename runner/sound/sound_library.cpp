#include "sound/sound_library.hpp"

#include "base/shared_library.hpp"
#include "base/try.hpp"

namespace tidemark::sound {
namespace {

Result<SoundLibrary> load_sndfile() {
    SoundLibrary functions;
    SharedLibrary library("libsndfile.so.1");
    library.find("sf_open_virtual", functions.open_virtual)
        .find("sf_readf_float", functions.read_frames)
        .find("sf_strerror", functions.message)
        .find("sf_close", functions.close);
    TRY(library.complete("libsndfile, which reads sound", "libsndfile1"));
    return functions;
}

} // namespace

const Result<SoundLibrary>& sound_library() {
    static const Result<SoundLibrary> library = load_sndfile();
    return library;
}

} // namespace tidemark::sound
