// The floor: the least that a program must do to draw a shader with no display and look at the pixels. A
// surfaceless EGL context, one program, one target, N draws, each read back; no file is written, nothing is
// left out that GL needs and nothing is added. What a host costs beyond this is the host's.
//
//     tidemark_floor SHADER WIDTH HEIGHT FRAMES FPS
//
// SHADER is a complete fragment shader, `#version` line and main() included. Frame i is drawn with iTime = i
// / FPS.
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace {

[[noreturn]] void stop(const std::string& why) {
    std::fprintf(stderr, "tidemark_floor: %s\n", why.c_str());
    std::exit(1);
}

std::string text_of(const char* path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        stop(std::string("cannot read ") + path);
    }
    return {std::istreambuf_iterator<char>(file), {}};
}

void make_context() {
    auto* display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr) ||
        !eglBindAPI(EGL_OPENGL_API)) {
        stop("no surfaceless EGL display");
    }
    const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                             4,
                             EGL_CONTEXT_MINOR_VERSION,
                             5,
                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                             EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                             EGL_NONE};
    auto* context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
    if (context == EGL_NO_CONTEXT || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
        stop("no OpenGL 4.5 core context");
    }
}

void attach(GLuint program, GLenum stage, const std::string& text) {
    const GLuint shader = glCreateShader(stage);
    const char* begin = text.c_str();
    glShaderSource(shader, 1, &begin, nullptr);
    glCompileShader(shader);
    glAttachShader(program, shader);
    glDeleteShader(shader);
}

GLuint make_program(const std::string& fragment) {
    const GLuint program = glCreateProgram();
    attach(program, GL_VERTEX_SHADER,
           "#version 450 core\n"
           "void main() {\n"
           "    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);\n"
           "    gl_Position = vec4(4.0 * corner - 1.0, 0.0, 1.0);\n"
           "}\n");
    attach(program, GL_FRAGMENT_SHADER, fragment);
    glLinkProgram(program);
    GLint linked = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked) {
        std::string log(size_t{1} << 16, '\0');
        GLsizei length = 0;
        glGetProgramInfoLog(program, GLsizei(log.size()), &length, log.data());
        log.resize(size_t(length));
        stop(log);
    }
    return program;
}

/// 256 x 256 RGBA8, mipmapped, repeating; any white noise will do for a timing.
void bind_noise(GLuint unit) {
    constexpr GLsizei k_size = 256;
    std::vector<uint32_t> texels(size_t{k_size} * k_size);
    uint32_t state = 1;
    for (uint32_t& texel : texels) {
        state = state * 1664525U + 1013904223U;
        texel = state ^ (state >> 15);
    }
    GLuint texture = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 9, GL_RGBA8, k_size, k_size);
    glTextureSubImage2D(texture, 0, 0, 0, k_size, k_size, GL_RGBA, GL_UNSIGNED_BYTE, texels.data());
    glGenerateTextureMipmap(texture);
    glTextureParameteri(texture, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glBindTextureUnit(unit, texture);
}

void make_target(GLsizei width, GLsizei height) {
    GLuint color = 0;
    GLuint target = 0;
    GLuint no_vertices = 0;
    glCreateRenderbuffers(1, &color);
    glNamedRenderbufferStorage(color, GL_RGBA8, width, height);
    glCreateFramebuffers(1, &target);
    glNamedFramebufferRenderbuffer(target, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color);
    if (glCheckNamedFramebufferStatus(target, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        stop("no target of that size");
    }
    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glViewport(0, 0, width, height);
    glCreateVertexArrays(1, &no_vertices);
    glBindVertexArray(no_vertices);
}

} // namespace

int main(int argc, char** argv) {
    if (argc != 6) {
        stop("usage: tidemark_floor SHADER WIDTH HEIGHT FRAMES FPS");
    }
    const int width = std::atoi(argv[2]);
    const int height = std::atoi(argv[3]);
    const int frames = std::atoi(argv[4]);
    const double fps = std::atof(argv[5]);
    if (width < 1 || height < 1 || frames < 1 || !(fps > 0)) {
        stop("width, height, frames and fps are numbers above zero");
    }

    make_context();
    const GLuint program = make_program(text_of(argv[1]));
    glUseProgram(program);
    make_target(width, height);
    if (const GLint channel = glGetUniformLocation(program, "iChannel0"); channel >= 0) {
        bind_noise(0);
        glUniform1i(channel, 0);
    }
    glUniform3f(glGetUniformLocation(program, "iResolution"), float(width), float(height), 1.0F);
    const GLint time = glGetUniformLocation(program, "iTime");

    std::vector<uint8_t> pixels(size_t(width) * size_t(height) * 4);
    uint64_t checksum = 14695981039346656037U;
    for (int frame = 0; frame < frames; ++frame) {
        glUniform1f(time, float(frame / fps));
        glDrawArrays(GL_TRIANGLES, 0, 3);
        glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels.data());
        // One word a row: enough to notice a wrong frame, too little to show in a timing.
        for (size_t at = 0; at < pixels.size(); at += size_t(width) * 4) {
            checksum =
                (checksum ^ pixels[at] ^ (uint64_t{pixels[at + 1]} << 8) ^ (uint64_t{pixels[at + 2]} << 16)) *
                1099511628211U;
        }
    }
    std::printf("%d frames %016llx\n", frames, static_cast<unsigned long long>(checksum));
    return 0;
}
