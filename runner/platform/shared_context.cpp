#include "platform/shared_context.hpp"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include <utility>

namespace tidemark::platform {

int reset_strategy(ResetNotice notice) {
    return notice == ResetNotice::yes ? EGL_LOSE_CONTEXT_ON_RESET : EGL_NO_RESET_NOTIFICATION;
}

Result<SharedContext> SharedContext::create(void* display, void* first, void* surface, ResetNotice notice) {
    EGLint wanted[] = {EGL_CONFIG_ID, 0, EGL_NONE};
    EGLConfig config = EGL_NO_CONFIG_KHR; // the value of a context without surfaces
    EGLint count = 0;
    eglQueryContext(display, first, EGL_CONFIG_ID, &wanted[1]);
    if (wanted[1] != 0)
        eglChooseConfig(display, wanted, &config, 1, &count);
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 4,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 5,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY,
                                 reset_strategy(notice),
                                 EGL_NONE};
    eglBindAPI(EGL_OPENGL_API); // each thread has its own setting
    SharedContext made;
    made.display_ = display;
    made.window_ = surface;
    made.context_ = eglCreateContext(display, config, first, attributes);
    if (made.context_)
        return made;
    return fail(ErrorCode::no_context,
                fmt::format("the driver gives no second OpenGL context: EGL error {:#06x}", eglGetError()));
}

SharedContext::SharedContext(SharedContext&& other) noexcept
    : display_(other.display_), window_(other.window_), context_(std::exchange(other.context_, nullptr)) {}

SharedContext& SharedContext::operator=(SharedContext&& other) noexcept {
    std::swap(display_, other.display_);
    std::swap(window_, other.window_);
    std::swap(context_, other.context_);
    return *this;
}

SharedContext::~SharedContext() {
    if (!context_)
        return;
    if (eglGetCurrentContext() == context_)
        leave();
    eglDestroyContext(display_, context_);
}

Result<void> SharedContext::make_current() {
    return make_current_with(EGL_NO_SURFACE);
}

Result<void> SharedContext::make_current_in_window() {
    return make_current_with(window_);
}

Result<void> SharedContext::make_current_with(void* surface) {
    eglBindAPI(EGL_OPENGL_API); // each thread has its own setting
    if (eglMakeCurrent(display_, surface, surface, context_))
        return {};
    return fail(ErrorCode::no_context,
                fmt::format("cannot use a second OpenGL context: EGL error {:#06x}", eglGetError()));
}

void SharedContext::leave() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

KeepCurrent::KeepCurrent()
    : display_(eglGetCurrentDisplay()), context_(eglGetCurrentContext()),
      draw_(eglGetCurrentSurface(EGL_DRAW)), read_(eglGetCurrentSurface(EGL_READ)) {}

KeepCurrent::~KeepCurrent() {
    if (context_)
        eglMakeCurrent(display_, draw_, read_, context_);
    else
        eglMakeCurrent(eglGetCurrentDisplay(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

} // namespace tidemark::platform
