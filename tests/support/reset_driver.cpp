// Preloaded into the program under test: a graphics driver that is reset, or that has no memory, at a draw of
// one's choosing. TIDEMARK_TEST_RESET and TIDEMARK_TEST_OUT_OF_MEMORY say at which, counted from 1; it is
// told once, so that a context made afterwards is a good one. With
// TIDEMARK_TEST_NO_TARGET no picture to draw into gets memory.
#include <dlfcn.h>

#include <atomic>
#include <cstdlib>

namespace {

constexpr unsigned k_out_of_memory = 0x0505;
constexpr unsigned k_guilty = 0x8253;

std::atomic<int> draws = 0;
std::atomic<bool> target_failed = false; ///< and nobody asked yet

/// Returns whether that draw was made and was not reported yet.
bool is_due(const char* variable, std::atomic<bool>& told) {
    const char* const number = std::getenv(variable);
    return number && draws >= std::atoi(number) && !told.exchange(true);
}

template <class Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

} // namespace

extern "C" {

void glDrawArrays(unsigned mode, int first, int count) {
    static const auto draw = next<void (*)(unsigned, int, int)>("glDrawArrays");
    ++draws;
    draw(mode, first, count);
}

/// Makes new targets fail: drivers take their memory here.
void glClearTexImage(unsigned texture, int level, unsigned format, unsigned type, const void* data) {
    static const auto clear =
        next<void (*)(unsigned, int, unsigned, unsigned, const void*)>("glClearTexImage");
    target_failed = std::getenv("TIDEMARK_TEST_NO_TARGET") != nullptr;
    clear(texture, level, format, type, data);
}

unsigned glGetGraphicsResetStatus() {
    static const auto status = next<unsigned (*)()>("glGetGraphicsResetStatus");
    static std::atomic<bool> told = false;
    return is_due("TIDEMARK_TEST_RESET", told) ? k_guilty : status();
}

unsigned glGetError() {
    static const auto error = next<unsigned (*)()>("glGetError");
    static std::atomic<bool> told = false;
    if (target_failed.exchange(false))
        return k_out_of_memory;
    return is_due("TIDEMARK_TEST_OUT_OF_MEMORY", told) ? k_out_of_memory : error();
}
}
