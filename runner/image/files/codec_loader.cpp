#include "image/files/codec_loader.hpp"

#include "base/plug_in.hpp"

#include <future>
#include <system_error>
#include <thread>

namespace tidemark::image {
namespace {

/// Checks that enough threads can be created. The plug-in's libraries start threads while loading, and end
/// the process or block forever if they cannot. The driver may start its own threads at the same time.
bool threads_are_to_be_had() {
    const unsigned count = 8 + 2 * std::thread::hardware_concurrency();
    std::promise<void> end;
    const std::shared_future<void> ended = end.get_future().share();
    bool good = true;
    std::vector<std::jthread> threads;
    try {
        while (threads.size() < count)
            threads.emplace_back([ended] { ended.wait(); });
    } catch (const std::system_error&) {
        good = false;
    }
    end.set_value();
    return good;
}

Result<const PictureCodec*> load_codec() {
    if (!threads_are_to_be_had())
        return fail(ErrorCode::load, "cannot load the picture plug-in: the system allows too few threads, or "
                                     "too little memory for them");
    const PlugIn plug_in{"tidemark_pictures.so", "picture plug-in",     "reading and writing pictures",
                         "OpenImageIO 2.4",      k_picture_codec_entry, k_picture_codec_version};
    return load_plug_in<PictureCodec>(plug_in);
}

} // namespace

const Result<const PictureCodec*>& picture_codec() {
    static const Result<const PictureCodec*> codec = load_codec();
    return codec;
}

} // namespace tidemark::image
