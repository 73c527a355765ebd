// Move-only owners of OpenGL objects; 0 is empty. The context must be current when an object is created or
// destroyed.
#pragma once

#include "base/extent.hpp"

#include <GL/glcorearb.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace tidemark::gl {

/// `Delete` is the GL function that deletes one object, `Delete(id)`, or several, `Delete(count, ids)`.
template <auto Delete>
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
        if (id_ == 0)
            return;
        if constexpr (std::is_invocable_v<decltype(Delete), GLuint>)
            Delete(id_);
        else
            Delete(1, &id_);
    }

    GLuint id() const { return id_; }
    explicit operator bool() const { return id_ != 0; }

private:
    GLuint id_ = 0;
};

using TextureHandle = Handle<glDeleteTextures>;
using SamplerHandle = Handle<glDeleteSamplers>;
using FramebufferHandle = Handle<glDeleteFramebuffers>;
using VertexArrayHandle = Handle<glDeleteVertexArrays>;
using ShaderHandle = Handle<glDeleteShader>;
using ProgramHandle = Handle<glDeleteProgram>;
using BufferHandle = Handle<glDeleteBuffers>;
using QueryHandle = Handle<glDeleteQueries>;

/// Makes a vertex array without attributes, which drawing requires.
VertexArrayHandle make_vertex_array();

// Creates, fills and reads 2-D, 3-D and cube textures, and creates samplers.

/// Returns whether samples of the format are bytes; otherwise they are floats.
bool holds_bytes(GLenum internal_format);

struct Texture {
    TextureHandle handle;
    GLenum target = 0; ///< GL_TEXTURE_2D, GL_TEXTURE_CUBE_MAP, GL_TEXTURE_3D
    Extent extent;
    int depth = 1; ///< 6 for a cube
    GLenum internal_format = 0;
    int levels = 0;
    bool es =
        false; ///< made with OpenGL ES, as its context: asking the driver in each draw would wait for it

    GLuint id() const { return handle.id(); }
};

/// Allocates storage without content. `levels` 0 stands for a full mipmap chain.
Texture make_texture(Extent extent, GLenum internal_format, int levels);
Texture make_cube_texture(int side, GLenum internal_format, int levels);
Texture make_volume_texture(Extent extent, int depth, GLenum internal_format, int levels);

/// Returns width, height and layers of a level; a cube has six layers at each.
std::array<int, 3> level_size(const Texture& texture, int level);

/// Reads a level as RGBA floats, row by row, one face or slice after the other.
std::vector<float> read_level(const Texture& texture, int level);

/// Reads a part of level 0 as RGBA floats, bottom row first (`layer`: a cube's face, a volume's slice). Waits
/// for drawing into the texture. The part must lie within the texture.
std::vector<float> read_part(const Texture& texture, int layer, const Rectangle& part);

/// Returns whether the driver had memory for the texture. A texture without storage reads as black.
bool has_storage(const Texture& texture);

/// Fills level 0 from tightly packed rows, row 0 first (`layer`: a cube's face, a volume's slice). Does not
/// change other levels: see `make_mipmaps`.
void upload(const Texture& texture, int layer, GLenum format, GLenum type, std::span<const std::byte> pixels);

/// Sets the components (GL_RED … GL_ALPHA, GL_ZERO, GL_ONE) that samples have as red, green, blue and alpha.
void set_swizzle(const Texture& texture, const std::array<GLint, 4>& components);

/// Binds the texture to a unit of the current context, for drawing.
void bind_texture(GLuint unit, const Texture& texture);

/// Returns the texture's size in the driver's memory, all levels included.
size_t bytes_of(const Texture& texture);

/// Computes the other levels, if any, from level 0.
void make_mipmaps(const Texture& texture);

SamplerHandle make_sampler(GLenum minify, GLenum magnify, GLenum wrap);

// A texture with a framebuffer: is drawn into, copied and read back.

struct RenderTarget {
    Texture texture;
    FramebufferHandle framebuffer;

    Extent extent() const { return texture.extent; }
};

/// Attaches the texture to a framebuffer and clears all its levels to zero. Returns nothing when the driver
/// cannot draw into such a texture or has no memory for it.
std::optional<RenderTarget> make_render_target(Texture texture);

/// Selects the face of a cube that is drawn into and read back.
void select_face(const RenderTarget& target, int face);

void clear(const RenderTarget& target);

/// Copies the overlap, aligned at the bottom left corner, pixel for pixel; of cubes, all faces. Both must
/// have the same format; they may belong to two contexts that share textures.
void copy_overlap(const RenderTarget& from, const RenderTarget& to);

/// Copies the target's pixels, bottom row first, tightly packed, after waiting for the drawing to end.
/// `pixels` must hold the whole target (the selected face of a cube).
void read_pixels(const RenderTarget& target, GLenum format, GLenum type, std::span<std::byte> pixels);

/// Copies the rectangle of that size in the target's bottom left corner, with rows `row_length` pixels apart;
/// else like read_pixels.
void read_corner(const RenderTarget& target, Extent size, GLenum format, GLenum type, int row_length,
                 std::byte* pixels);

/// Fills the default framebuffer with black.
void clear_window();

/// Draws the target into the default framebuffer, stretched to fill it when the sizes differ. Leaves that
/// framebuffer bound for drawing.
void blit_to_window(const RenderTarget& target, Extent window);

// Restricts drawing to a rectangle while the object lives; one at a time per context.

class Scissor {
public:
    explicit Scissor(const Rectangle& box) {
        glEnable(GL_SCISSOR_TEST);
        glScissor(box.x, box.y, box.extent.width, box.extent.height);
    }
    ~Scissor() { glDisable(GL_SCISSOR_TEST); }
    Scissor(const Scissor&) = delete;
    Scissor& operator=(const Scissor&) = delete;
};

// Copies of whole pictures by the driver's blit: into the window or into another target.

/// Draws the target into the default framebuffer, centred and as large as its proportions allow; the rest is
/// black.
void blit_fitted(const RenderTarget& target, Extent window);

/// Returns a copy of the target as RGBA8, which is what a window shows; nothing when there is no memory for
/// it.
std::optional<RenderTarget> copy_in_bytes(const RenderTarget& target);

/// Wraps a texture that was drawn in another context. Contexts share textures but not framebuffers.
RenderTarget attach(Texture texture);

} // namespace tidemark::gl
