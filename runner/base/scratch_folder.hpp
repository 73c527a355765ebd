// A temporary folder for another program's files. The destructor removes it with its contents.
#pragma once

#include <filesystem>

namespace tidemark {

class ScratchFolder {
public:
    /// Makes a folder that only its owner may open. `path` is empty if it cannot be made.
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

} // namespace tidemark
