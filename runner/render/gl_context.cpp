#include "render/gl_context.hpp"

#include <GL/glcorearb.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#if defined(__x86_64__) || defined(__i386__)
#include <cpuid.h>
#endif

namespace tidemark::gl {
namespace {

const char* text_of(GLenum name) {
    const GLubyte* text = glGetString(name);
    return text ? reinterpret_cast<const char*>(text) : "unknown";
}

/// A limit, because a lost context may report errors without end.
constexpr int k_most_errors = 100;

bool ran_out_of_memory() {
    bool ran_out = false;
    for (int i = 0; i < k_most_errors; ++i) {
        const GLenum error = glGetError();
        if (error == GL_NO_ERROR)
            break;
        ran_out |= error == GL_OUT_OF_MEMORY;
    }
    return ran_out;
}

void APIENTRY keep(GLenum source, GLenum, GLuint, GLenum, GLsizei length, const GLchar* text,
                   const void* messages) {
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER)
        static_cast<std::vector<std::string>*>(const_cast<void*>(messages))
            ->emplace_back(text, length < 0 ? std::strlen(text) : size_t(length));
}

/// Returns `GenuineIntel` or `AuthenticAMD`, for example; empty if the processor has no such instruction.
/// Software drivers round as its instructions do (rcpps).
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

} // namespace

bool is_software_renderer(std::string_view renderer) {
    constexpr std::array<std::string_view, 4> k_software{"llvmpipe", "softpipe", "SwiftShader", "Software"};
    return std::ranges::any_of(
        k_software, [&](std::string_view name) { return renderer.find(name) != std::string_view::npos; });
}

Capabilities query_capabilities() {
    GLint texture = 0;
    GLint viewport[2] = {};
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
    const std::string renderer = text_of(GL_RENDERER);
    return {text_of(GL_VENDOR), renderer, text_of(GL_VERSION), std::min({texture, viewport[0], viewport[1]}),
            is_software_renderer(renderer) ? processor_maker() : ""};
}

bool is_es() {
    return std::string_view(text_of(GL_VERSION)).starts_with("OpenGL ES");
}

std::vector<std::string> query_extensions() {
    GLint count = 0;
    glGetIntegerv(GL_NUM_EXTENSIONS, &count);
    std::vector<std::string> names;
    for (GLint i = 0; i < count; ++i)
        names.emplace_back(reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, GLuint(i))));
    return names;
}

std::optional<std::string_view> reset_reason() {
    switch (glGetGraphicsResetStatus()) {
    case GL_NO_ERROR: return std::nullopt;
    case GL_GUILTY_CONTEXT_RESET: return "a draw call took too long or crashed it";
    case GL_INNOCENT_CONTEXT_RESET: return "another program caused it";
    default: return "it gives no reason";
    }
}

bool tells_resets() {
    GLint strategy = 0;
    glGetIntegerv(GL_RESET_NOTIFICATION_STRATEGY, &strategy);
    return strategy == GL_LOSE_CONTEXT_ON_RESET;
}

Result<void> check_work(std::string_view what) {
    if (const auto reason = reset_reason())
        return fail(ErrorCode::timed_out,
                    fmt::format("the graphics driver was reset while {}: {}", what, *reason));
    if (ran_out_of_memory())
        return fail(ErrorCode::no_memory,
                    fmt::format("the graphics driver ran out of memory while {}", what));
    return {};
}

CompilerMessages::CompilerMessages() {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS); // on this thread, before the compiling call returns
    glDebugMessageControl(GL_DEBUG_SOURCE_SHADER_COMPILER, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_TRUE);
    glDebugMessageCallback(keep, &messages_);
}

CompilerMessages::~CompilerMessages() {
    glDebugMessageCallback(nullptr, nullptr);
    glDisable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDisable(GL_DEBUG_OUTPUT);
}

std::vector<std::string> CompilerMessages::take() {
    return std::exchange(messages_, {});
}

} // namespace tidemark::gl
