// Plans which passes are drawn, in which order, what each reads, and what their targets need. Pure: the
// inputs are the scene and the active uniforms.
#pragma once

#include "base/error.hpp"
#include "render/gl_program.hpp"
#include "render/gl_textures.hpp"
#include "render/pass_state.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace tidemark::render {

/// Superfluous work, to measure what leaving it out saves. The picture stays the same.
struct Extras {
    bool passes = false;          ///< draws passes that are never read
    bool channels = false;        ///< loads channels that the program does not read
    bool mipmaps = false;         ///< of buffers that are sampled without mipmaps
    bool second_textures = false; ///< of buffers that do not read themselves
    bool uniforms = false;        ///< sets uniforms that the program does not have
    bool unchanged = false;       ///< draws passes whose inputs are unchanged
};

/// The frame that a read of a pass's output refers to.
enum class FrameRef { current, previous };

struct PlannedPass {
    size_t pass = 0;               ///< index into Scene::passes
    std::vector<int> channels;     ///< those that need a texture, ascending
    bool keyboard_helpers = false; ///< reads the texture of `#iKeyboard`
};

/// Requirements of the textures that a pass draws into.
struct TargetPlan {
    bool two_textures = false; ///< the pass reads its own last frame, or keeps pixels of it
    bool mipmaps = false;      ///< some reader filters between mipmaps
    int carried = 0;           ///< number of textures, newest first, that the next frame reads
};

struct FramePlan {
    std::vector<PlannedPass> passes; ///< in drawing order; needed ones only
    std::vector<TargetPlan> targets; ///< one for each pass of the scene
    bool feedback = false;           ///< a frame depends on the previous one

    const PlannedPass* find(size_t pass) const;
};

/// Returns whether a program of that pass needs the texture of channel `number`: it samples it, or reads its
/// size or time, which only the texture provides. The size of a pass's picture is known without its texture.
bool needs_texture(const scene::ChannelInput& input, int number, const gl::Reflection& reflection);

/// Applies ShaderToy's order: a pass reads earlier passes as of this frame, itself and later passes as of the
/// last frame.
FrameRef frame_ref(size_t reader, size_t source);

/// Returns whether a frame may depend on the previous one, judging by the channels without the texts.
bool may_have_feedback(const scene::Scene& scene);

/// Plans the passes that `shown` needs, itself included. `reflections` has one entry per pass of the scene;
/// those without (not linked) are not drawn. `discarding` lists the passes whose texts contain `discard`,
/// which keeps the target's content: in a buffer that is the frame before the last, as on ShaderToy, because
/// its two textures alternate; in Image the last frame.
FramePlan plan_frame(const scene::Scene& scene, const std::vector<std::optional<gl::Reflection>>& reflections,
                     size_t shown, const Extras& extras = {}, const std::vector<size_t>& discarding = {});

// The textures that keep a pass's output from frame to frame.

/// The side of a cubemap pass's faces, as on ShaderToy.
inline constexpr int k_cube_side = 1024;

/// Fails (ErrorCode::usage) if the driver of the current context cannot draw a picture of that size.
Result<void> check_size(Extent extent);

/// One texture, or two that alternate when a pass reads itself. They start as zeros.
class PassTarget {
public:
    PassTarget() = default;
    /// Fails when the driver cannot have targets of that size (ErrorCode::usage), or has no memory for them
    /// (ErrorCode::no_memory).
    static Result<PassTarget> create(Extent extent, GLenum internal_format, const TargetPlan& plan);
    static Result<PassTarget> create_cube(const TargetPlan& plan);

    /// Returns the last complete picture.
    const gl::RenderTarget& latest() const { return surfaces_[latest_]; }
    /// Returns the surface to draw into; `flip` makes it the latest.
    const gl::RenderTarget& next() const { return surfaces_[next_index()]; }
    /// Makes `next` the latest picture, for later passes of the frame, and computes its mipmaps. Frees the
    /// surface of `keep_apart`.
    void flip();

    /// Returns a surface for drawing the next picture while the current ones stay unchanged; nothing when the
    /// driver has no memory for it. `keeps`: some pixels are discarded, so it starts as a copy of `next`.
    std::optional<gl::RenderTarget> make_apart(bool keeps);
    /// Keeps the surface left by `take_over` for the next `make_apart`, so that frames drawn in parts need no
    /// further memory.
    void keep_apart(gl::RenderTarget spare) { spare_ = std::move(spare); }
    /// Exchanges `apart`, which has its mipmaps, with the surface of `next` and makes it the latest.
    void take_over(gl::RenderTarget& apart);
    /// Undoes `take_over`, in `apart` too.
    void take_back(gl::RenderTarget& apart);

    void clear();
    size_t bytes() const;
    GLenum internal_format() const { return latest().texture.internal_format; }
    /// Returns the generation of the picture in `latest`.
    Generation generation() const { return edition_; }
    /// Returns the textures that the next frame reads.
    std::vector<TextureFloats> carried() const;
    /// Returns whether `carried` comes from a target like this one.
    bool can_restore(const std::vector<TextureFloats>& carried) const;
    /// Restores the textures that `carried` returned.
    void restore(const std::vector<TextureFloats>& carried);
    /// Copies the overlap with the latest picture of `other`, which must have the same format.
    void continue_from(const PassTarget& other);
    /// Returns a target of another size with the overlap of the old picture in its bottom left corner.
    Result<PassTarget> resized(Extent extent) const;

private:
    size_t next_index() const { return surfaces_.size() - 1 - latest_; }

    std::vector<gl::RenderTarget> surfaces_;
    std::optional<gl::RenderTarget> spare_; ///< of the same kind; see `keep_apart`
    size_t latest_ = 0;
    Generation edition_ = 0;
    TargetPlan plan_;
};

} // namespace tidemark::render
