#include "base/installed.hpp"

#include <fmt/format.h>

#include <system_error>

namespace tidemark {
namespace fs = std::filesystem;

fs::path program_folder() {
    std::error_code ignored;
    return fs::read_symlink("/proc/self/exe", ignored).parent_path();
}

namespace {

fs::path beside_program(const char* name) {
    return program_folder() / name;
}

fs::path installed_folder(const char* name) {
    return (program_folder() / "../share/tidemark" / name).lexically_normal();
}

fs::path beside_or_installed(const char* name) {
    std::error_code ignored;
    fs::path beside = fs::canonical(beside_program(name), ignored);
    return beside.empty() ? installed_folder(name) : beside;
}

constexpr const char* k_library = "shaders/lib";

} // namespace

fs::path library_folder() {
    return beside_or_installed(k_library);
}

fs::path conformance_folder() {
    return beside_or_installed("conformance");
}

std::string why_no_library() {
    std::error_code ignored;
    if (fs::is_directory(library_folder(), ignored))
        return {};
    return fmt::format(
        "the shader library that comes with tidemark is not there: it was looked for in '{}' and "
        "in '{}'; install tidemark again, or leave its share/ where it is",
        beside_program(k_library).string(), installed_folder(k_library).string());
}

} // namespace tidemark
