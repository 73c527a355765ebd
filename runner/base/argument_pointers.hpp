// argv for exec and posix_spawn. The pointers are valid while the strings live.
#pragma once

#include <string>
#include <vector>

namespace tidemark {

/// Returns the strings' pointers and a null at the end. The system does not write to them, although its
/// interface takes `char*`.
inline std::vector<char*> argument_pointers(const std::vector<std::string>& words) {
    std::vector<char*> pointers;
    for (const std::string& word : words)
        pointers.push_back(const_cast<char*>(word.c_str()));
    pointers.push_back(nullptr);
    return pointers;
}

} // namespace tidemark
