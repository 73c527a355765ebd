#include "gl/reset.hpp"

#include <GL/glcorearb.h>
#include <fmt/format.h>

namespace tidemark::gl {
namespace {

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

} // namespace

std::optional<std::string_view> reset_reason() {
    switch (glGetGraphicsResetStatus()) {
    case GL_NO_ERROR: return std::nullopt;
    case GL_GUILTY_CONTEXT_RESET: return "what was drawn took too long for its watchdog, or broke it";
    case GL_INNOCENT_CONTEXT_RESET: return "another program broke it";
    default: return "it does not say why";
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

} // namespace tidemark::gl
