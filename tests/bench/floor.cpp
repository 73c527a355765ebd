// The floor: the least that a program must do to draw a shader with no display and look at the pixels. A
// surfaceless EGL context, one program, one target, N draws, each read back; no file is written, nothing is
// left out that GL needs and nothing is added. What a host costs beyond this is the host's.
//
//     tidemark_floor SHADER WIDTH HEIGHT FRAMES FPS [BUFFER...]
//
// SHADER is a complete fragment shader, `#version` line and main() included. Frame i is drawn with iTime = i
// / FPS. Each BUFFER is one more, drawn before it into RGBA32F: its iChannel0 is its own last frame, and
// SHADER's iChannel0, 1, ... are the buffers.
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

void set_inputs(GLuint program, int width, int height) {
    glUseProgram(program);
    glUniform3f(glGetUniformLocation(program, "iResolution"), float(width), float(height), 1.0F);
    for (GLint unit = 0; unit < 4; ++unit) {
        const std::string name = "iChannel" + std::to_string(unit);
        if (const GLint channel = glGetUniformLocation(program, name.c_str()); channel >= 0) {
            glUniform1i(channel, unit);
        }
    }
}

/// A pass that reads its own last frame: two textures by turns.
class Buffer {
public:
    Buffer(const std::string& fragment, int width, int height) : program_(make_program(fragment)) {
        set_inputs(program_, width, height);
        frame_ = glGetUniformLocation(program_, "iFrame");
        glCreateTextures(GL_TEXTURE_2D, 2, textures_);
        glCreateFramebuffers(2, targets_);
        for (int i = 0; i < 2; ++i) {
            glTextureStorage2D(textures_[i], 1, GL_RGBA32F, width, height);
            glNamedFramebufferTexture(targets_[i], GL_COLOR_ATTACHMENT0, textures_[i], 0);
            glClearTexImage(textures_[i], 0, GL_RGBA, GL_FLOAT, nullptr);
        }
    }
    void draw(int frame) {
        glUseProgram(program_);
        glUniform1i(frame_, frame);
        glBindTextureUnit(0, textures_[latest_]);
        latest_ = 1 - latest_;
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, targets_[latest_]);
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
    GLuint latest() const { return textures_[latest_]; }

private:
    GLuint program_;
    GLint frame_ = -1;
    GLuint textures_[2] = {};
    GLuint targets_[2] = {};
    int latest_ = 0;
};

GLuint make_target(GLsizei width, GLsizei height) {
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
    return target;
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 6 || argc > 10) {
        stop("usage: tidemark_floor SHADER WIDTH HEIGHT FRAMES FPS [BUFFER...], four buffers at most");
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
    const GLuint target = make_target(width, height);
    set_inputs(program, width, height);
    const GLint time = glGetUniformLocation(program, "iTime");
    std::vector<Buffer> buffers;
    for (int i = 6; i < argc; ++i) {
        buffers.emplace_back(text_of(argv[i]), width, height);
    }
    if (buffers.empty() && glGetUniformLocation(program, "iChannel0") >= 0) {
        bind_noise(0);
    }

    std::vector<uint8_t> pixels(size_t(width) * size_t(height) * 4);
    uint64_t checksum = 14695981039346656037U;
    for (int frame = 0; frame < frames; ++frame) {
        for (Buffer& buffer : buffers) {
            buffer.draw(frame);
        }
        for (size_t unit = 0; unit < buffers.size(); ++unit) {
            glBindTextureUnit(GLuint(unit), buffers[unit].latest());
        }
        glBindFramebuffer(GL_FRAMEBUFFER, target);
        glUseProgram(program);
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
