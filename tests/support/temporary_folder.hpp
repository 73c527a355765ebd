// A fresh folder for one test, its real path, removed with what is in it; and ways to save a file there and
// to look at one.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

namespace tidemark {

class TemporaryFolder {
public:
    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "tidemark-XXXXXX").string();
        path_ = std::filesystem::canonical(mkdtemp(name.data()));
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    std::filesystem::path operator/(std::string_view name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

inline void save_in_place(const std::filesystem::path& file, std::string_view text = "text\n") {
    std::ofstream(file, std::ios::trunc) << text;
}

/// As most editors do it.
inline void save_and_rename(const std::filesystem::path& file, std::string_view text = "text\n") {
    const std::filesystem::path fresh = file.string() + ".new";
    save_in_place(fresh, text);
    std::filesystem::rename(fresh, file);
}

inline std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
}

} // namespace tidemark
