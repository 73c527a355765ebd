#include "image/files/codec_loader.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <future>
#include <system_error>
#include <thread>

namespace tidemark::image {
namespace fs = std::filesystem;
namespace {

tl::unexpected<Error> unusable(const fs::path& plugin, const std::string& why) {
    return fail(ErrorCode::load,
                fmt::format("cannot load the picture plug-in '{}': {}; install OpenImageIO 2.4 "
                            "and the plug-in of this build of Tidemark",
                            plugin.string(), why));
}

std::string last_loader_error() {
    const char* message = ::dlerror();
    return message ? message : "the loader gives no reason";
}

Result<const PictureCodec*> codec_of(void* library, const fs::path& plugin) {
    const auto entry = reinterpret_cast<PictureCodecEntry>(::dlsym(library, k_picture_codec_entry));
    if (!entry)
        return unusable(plugin, "it is not Tidemark's");
    const PictureCodec* codec = entry();
    if (codec->version != k_picture_codec_version)
        return unusable(plugin, fmt::format("it has version {}, this program needs {}", codec->version,
                                            k_picture_codec_version));
    return codec;
}

/// Libraries behind the plug-in start threads while they are loaded, and end the process or wait for ever
/// where they get none. The driver may be starting its own meanwhile.
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

void* open_library(const fs::path& plugin) {
    // Lazy, because most of the thousands of functions in OpenImageIO's libraries are never called; for
    // good, because their destructors run at exit; local, because they bring symbols of everyone's.
    return ::dlopen(plugin.c_str(), RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE);
}

} // namespace

Result<const PictureCodec*> load_picture_codec(const fs::path& file_name,
                                               const std::vector<fs::path>& folders) {
    std::string looked_in;
    for (const fs::path& folder : folders) {
        const fs::path plugin = folder / file_name;
        std::error_code ignored;
        if (!fs::exists(plugin, ignored)) {
            looked_in += fmt::format("'{}', ", folder.string());
            continue;
        }
        if (!threads_are_to_be_had())
            return fail(ErrorCode::load,
                        fmt::format("cannot load the picture plug-in '{}': the system allows too "
                                    "few threads, or too little memory for them",
                                    plugin.string()));
        if (void* library = open_library(plugin))
            return codec_of(library, plugin);
        return unusable(plugin, last_loader_error());
    }
    if (void* library = open_library(file_name))
        return codec_of(library, file_name);
    const std::string why = last_loader_error();
    // The loader's own words matter only where it found the plug-in and missed something else.
    if (why.find(file_name.string() + ": cannot open shared object file") == std::string::npos)
        return unusable(file_name, why);
    return fail(ErrorCode::load,
                fmt::format("reading and writing pictures needs the plug-in '{}', which is not in "
                            "{}or where the system looks for libraries; reinstall Tidemark or "
                            "put the plug-in beside the program",
                            file_name.string(), looked_in));
}

const Result<const PictureCodec*>& picture_codec() {
    static const Result<const PictureCodec*> codec = [] {
        std::error_code ignored;
        const fs::path home = fs::read_symlink("/proc/self/exe", ignored).parent_path();
        return load_picture_codec("tidemark_pictures.so",
                                  {home, (home / "../lib/tidemark").lexically_normal()});
    }();
    return codec;
}

} // namespace tidemark::image
