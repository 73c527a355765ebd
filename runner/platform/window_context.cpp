#include "platform/window_context.hpp"

#include <EGL/egl.h>
#include <fmt/format.h>

#include <utility>

namespace tidemark::platform {

WindowContext::WindowContext(WindowContext&& other) noexcept
    : display_(other.display_), window_(other.window_), context_(std::exchange(other.context_, nullptr)) {}

WindowContext& WindowContext::operator=(WindowContext&& other) noexcept {
    std::swap(display_, other.display_);
    std::swap(window_, other.window_);
    std::swap(context_, other.context_);
    return *this;
}

WindowContext::~WindowContext() {
    if (!context_)
        return;
    if (eglGetCurrentContext() == context_)
        leave();
    eglDestroyContext(display_, context_);
}

Result<void> WindowContext::make_current() {
    return make_current_with(EGL_NO_SURFACE);
}

Result<void> WindowContext::make_current_in_window() {
    return make_current_with(window_);
}

Result<void> WindowContext::make_current_with(void* surface) {
    eglBindAPI(EGL_OPENGL_API); // each thread has its own
    if (eglMakeCurrent(display_, surface, surface, context_))
        return {};
    return fail(ErrorCode::no_context,
                fmt::format("cannot use a second OpenGL context: EGL error {:#06x}", eglGetError()));
}

void WindowContext::leave() {
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
