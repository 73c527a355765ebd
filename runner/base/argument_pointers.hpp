// Words as the system wants them for another program. Valid as long as the words are.
#pragma once

#include <string>
#include <vector>

namespace tidemark {

/// With the null at the end. Nobody writes into them: the system only forgets to say so.
inline std::vector<char*> argument_pointers(const std::vector<std::string>& words) {
    std::vector<char*> pointers;
    for (const std::string& word : words)
        pointers.push_back(const_cast<char*>(word.c_str()));
    pointers.push_back(nullptr);
    return pointers;
}

} // namespace tidemark
