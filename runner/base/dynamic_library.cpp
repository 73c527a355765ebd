#include "base/dynamic_library.hpp"

#include "base/folders.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <string>
#include <system_error>

namespace tidemark {
namespace {

std::string last_words() {
    const char* why = ::dlerror();
    return why ? why : "the loader gives no reason";
}

} // namespace

SharedLibrary::SharedLibrary(const char* file)
    : handle_(::dlopen(file, RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE)) {
    if (!handle_)
        missing_ = last_words();
}

void* SharedLibrary::address_of(const char* name) {
    void* address = handle_ ? ::dlsym(handle_, name) : nullptr;
    if (!address && missing_.empty())
        missing_ = last_words();
    return address;
}

Result<void> SharedLibrary::complete(std::string_view what, std::string_view package) const {
    if (missing_.empty())
        return {};
    return fail(ErrorCode::load,
                fmt::format("cannot load {}: {}; install the package {}", what, missing_, package));
}

namespace fs = std::filesystem;
namespace {

tl::unexpected<Error> unusable(const PlugIn& plug_in, const fs::path& file, const std::string& why) {
    return fail(
        ErrorCode::load,
        fmt::format("cannot load the {} '{}': {}; install {} and the plug-in of this build of Tidemark",
                    plug_in.name, file.string(), why, plug_in.requirement));
}

std::string last_loader_error() {
    const char* message = ::dlerror();
    return message ? message : "the loader gives no reason";
}

Result<const void*> table_of(void* library, const PlugIn& plug_in, const fs::path& file) {
    const auto entry = reinterpret_cast<const void* (*)()>(::dlsym(library, plug_in.entry));
    if (!entry)
        return unusable(plug_in, file, "it is not a plug-in of Tidemark");
    const void* table = entry();
    const unsigned version = *static_cast<const unsigned*>(table);
    if (version != plug_in.version)
        return unusable(plug_in, file,
                        fmt::format("it has version {}, this program needs {}", version, plug_in.version));
    return table;
}

void* open_library(const fs::path& file) {
    // Lazy, because most of the thousands of functions in a plug-in's libraries are never called; never
    // unloaded, because their destructors run at exit; local, because they bring common libraries' symbols.
    return ::dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL | RTLD_NODELETE);
}

} // namespace

std::vector<fs::path> plug_in_folders() {
    const fs::path home = program_folder();
    return {home, (home / "../lib/tidemark").lexically_normal()};
}

Result<const void*> load_plug_in(const PlugIn& plug_in, const std::vector<fs::path>& folders) {
    std::string looked_in;
    for (const fs::path& folder : folders) {
        const fs::path file = folder / plug_in.file;
        std::error_code ignored;
        if (!fs::exists(file, ignored)) {
            looked_in += fmt::format("'{}', ", folder.string());
            continue;
        }
        if (void* library = open_library(file))
            return table_of(library, plug_in, file);
        return unusable(plug_in, file, last_loader_error());
    }
    if (void* library = open_library(plug_in.file))
        return table_of(library, plug_in, plug_in.file);
    const std::string why = last_loader_error();
    // The loader's message matters only if it found the plug-in and missed something else.
    if (why.find(plug_in.file.string() + ": cannot open shared object file") == std::string::npos)
        return unusable(plug_in, plug_in.file, why);
    return fail(ErrorCode::load,
                fmt::format("{} needs the plug-in '{}', which is not in {}or where the system looks for "
                            "libraries; reinstall Tidemark or put the plug-in beside the program",
                            plug_in.purpose, plug_in.file.string(), looked_in));
}

} // namespace tidemark
