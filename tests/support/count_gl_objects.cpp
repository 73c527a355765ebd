// Preloaded into the program (LD_PRELOAD) by tests/live/soak_test.py: how many OpenGL objects it has, as one
// int of each kind, in the file that $TIDEMARK_GL_OBJECTS names. Only the process that makes that file
// counts, none it forks.
#include <GL/glcorearb.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>

namespace {

enum Kind { textures, samplers, framebuffers, vertex_arrays, shaders, programs, buffers, queries, kinds };
using Counts = std::atomic<int>[kinds];

Counts* counts = nullptr;
pid_t owner = 0;

__attribute__((constructor)) void open_counts() {
    const char* const name = std::getenv("TIDEMARK_GL_OBJECTS");
    const int file = name ? ::open(name, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600) : -1;
    if (file < 0)
        return;
    if (::ftruncate(file, sizeof(Counts)) == 0) {
        void* const place = ::mmap(nullptr, sizeof(Counts), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
        counts = place == MAP_FAILED ? nullptr : static_cast<Counts*>(place);
    }
    ::close(file);
    owner = ::getpid();
}

void count(Kind kind, int change) {
    if (counts && ::getpid() == owner)
        (*counts)[kind] += change;
}

template <typename Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

} // namespace

#define MAKES(kind, name)                                                                                    \
    extern "C" void name(GLsizei n, GLuint* ids) {                                                           \
        static const auto real = next<void (*)(GLsizei, GLuint*)>(#name);                                    \
        real(n, ids);                                                                                        \
        count(kind, n);                                                                                      \
    }
#define MAKES_OF_TYPE(kind, name)                                                                            \
    extern "C" void name(GLenum type, GLsizei n, GLuint* ids) {                                              \
        static const auto real = next<void (*)(GLenum, GLsizei, GLuint*)>(#name);                            \
        real(type, n, ids);                                                                                  \
        count(kind, n);                                                                                      \
    }
#define DROPS(kind, name)                                                                                    \
    extern "C" void name(GLsizei n, const GLuint* ids) {                                                     \
        static const auto real = next<void (*)(GLsizei, const GLuint*)>(#name);                              \
        real(n, ids);                                                                                        \
        count(kind, -n);                                                                                     \
    }
#define DROPS_ONE(kind, name)                                                                                \
    extern "C" void name(GLuint id) {                                                                        \
        static const auto real = next<void (*)(GLuint)>(#name);                                              \
        real(id);                                                                                            \
        count(kind, -1);                                                                                     \
    }

MAKES_OF_TYPE(textures, glCreateTextures)
MAKES(samplers, glCreateSamplers)
MAKES(framebuffers, glCreateFramebuffers)
MAKES(vertex_arrays, glCreateVertexArrays)
MAKES(buffers, glCreateBuffers)
MAKES_OF_TYPE(queries, glCreateQueries)
DROPS(textures, glDeleteTextures)
DROPS(samplers, glDeleteSamplers)
DROPS(framebuffers, glDeleteFramebuffers)
DROPS(vertex_arrays, glDeleteVertexArrays)
DROPS(buffers, glDeleteBuffers)
DROPS(queries, glDeleteQueries)
DROPS_ONE(shaders, glDeleteShader)
DROPS_ONE(programs, glDeleteProgram)

extern "C" GLuint glCreateShader(GLenum type) {
    static const auto real = next<GLuint (*)(GLenum)>("glCreateShader");
    count(shaders, 1);
    return real(type);
}

extern "C" GLuint glCreateProgram() {
    static const auto real = next<GLuint (*)()>("glCreateProgram");
    count(programs, 1);
    return real();
}
