// Tests that are files: one `.glsl` each.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace tidemark {

/// The names of the cases in a folder, in order, without the suffix.
inline std::vector<std::string> case_names(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".glsl")
            names.push_back(entry.path().stem());
    std::sort(names.begin(), names.end());
    return names;
}

} // namespace tidemark
