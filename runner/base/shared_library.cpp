#include "base/shared_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

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

} // namespace tidemark
