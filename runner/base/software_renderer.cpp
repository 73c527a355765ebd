#include "base/software_renderer.hpp"

#if defined(__x86_64__) || defined(__i386__)
#include <cpuid.h>

#include <cstring>
#endif

namespace tidemark {

std::string processor_maker() {
#if defined(__x86_64__) || defined(__i386__)
    unsigned level = 0;
    unsigned words[3] = {}; // four letters each, in this order
    if (__get_cpuid(0, &level, &words[0], &words[2], &words[1])) {
        char letters[sizeof words];
        std::memcpy(letters, words, sizeof words);
        return {letters, sizeof letters};
    }
#endif
    return {};
}

} // namespace tidemark
