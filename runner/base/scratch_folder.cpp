#include "base/scratch_folder.hpp"

#include <cstdlib>
#include <string>
#include <system_error>

namespace tidemark {
namespace fs = std::filesystem;

ScratchFolder::ScratchFolder() {
    std::error_code failed;
    std::string name = (fs::temp_directory_path(failed) / "tidemark-XXXXXX").string();
    if (::mkdtemp(name.data()))
        path_ = std::move(name);
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    if (!path_.empty())
        fs::remove_all(path_, ignored);
}

} // namespace tidemark
