#include "base/installed.hpp"

#include <system_error>

namespace tidemark {
namespace fs = std::filesystem;

fs::path program_folder() {
    std::error_code ignored;
    return fs::read_symlink("/proc/self/exe", ignored).parent_path();
}

fs::path library_folder() {
    const fs::path home = program_folder();
    std::error_code ignored;
    fs::path beside = fs::canonical(home / "shaders/lib", ignored);
    return beside.empty() ? (home / "../share/tidemark/shaders/lib").lexically_normal() : beside;
}

} // namespace tidemark
