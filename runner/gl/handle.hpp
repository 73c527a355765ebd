// Move-only owners of OpenGL objects; 0 is empty. The context must be current when an object is created or
// destroyed.
#pragma once

#include <GL/glcorearb.h>

#include <utility>

namespace tidemark::gl {

/// `Delete(id)` deletes the GL object.
template <void (*Delete)(GLuint)>
class Handle {
public:
    Handle() = default;
    explicit Handle(GLuint id) : id_(id) {}
    Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(id_, other.id_);
        return *this;
    }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() {
        if (id_ != 0)
            Delete(id_);
    }

    GLuint id() const { return id_; }
    explicit operator bool() const { return id_ != 0; }

private:
    GLuint id_ = 0;
};

void delete_texture(GLuint id);
void delete_sampler(GLuint id);
void delete_framebuffer(GLuint id);
void delete_vertex_array(GLuint id);
void delete_shader(GLuint id);
void delete_program(GLuint id);
void delete_buffer(GLuint id);
void delete_query(GLuint id);

using TextureHandle = Handle<delete_texture>;
using SamplerHandle = Handle<delete_sampler>;
using FramebufferHandle = Handle<delete_framebuffer>;
using VertexArrayHandle = Handle<delete_vertex_array>;
using ShaderHandle = Handle<delete_shader>;
using ProgramHandle = Handle<delete_program>;
using BufferHandle = Handle<delete_buffer>;
using QueryHandle = Handle<delete_query>;

} // namespace tidemark::gl
