#include "base/installed.hpp"

#include <system_error>

namespace tidemark {
namespace fs = std::filesystem;

fs::path program_folder() {
    std::error_code ignored;
    return fs::read_symlink("/proc/self/exe", ignored).parent_path();
}

namespace {

fs::path beside_or_installed(const char* name) {
    const fs::path home = program_folder();
    std::error_code ignored;
    fs::path beside = fs::canonical(home / name, ignored);
    return beside.empty() ? (home / "../share/tidemark" / name).lexically_normal() : beside;
}

} // namespace

fs::path library_folder() {
    return beside_or_installed("shaders/lib");
}

fs::path conformance_folder() {
    return beside_or_installed("conformance");
}

} // namespace tidemark
