// Plans which passes are drawn, in which order, what each reads, and what their targets need. Pure: the
// inputs are the scene and the active uniforms.
#pragma once

#include "gl/program.hpp"
#include "scene/scene.hpp"

#include <optional>
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

} // namespace tidemark::render
