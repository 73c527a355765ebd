// A folder of our own among the temporary files, for another program's files; it goes with all that is in it.
#pragma once

#include <filesystem>

namespace tidemark {

class ScratchFolder {
public:
    /// Only its owner may look into it. Empty where it cannot be made.
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

} // namespace tidemark
