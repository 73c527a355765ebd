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

fs::path beside_program() {
    return program_folder() / "shaders/lib";
}

fs::path installed_folder() {
    return (program_folder() / "../share/tidemark/shaders/lib").lexically_normal();
}

} // namespace

fs::path library_folder() {
    std::error_code ignored;
    fs::path beside = fs::canonical(beside_program(), ignored);
    return beside.empty() ? installed_folder() : beside;
}

std::string why_no_library() {
    std::error_code ignored;
    if (fs::is_directory(library_folder(), ignored))
        return {};
    return fmt::format(
        "the shader library that comes with tidemark is not there: it was looked for in '{}' and "
        "in '{}'; install tidemark again, or leave its share/ where it is",
        beside_program().string(), installed_folder().string());
}

} // namespace tidemark
