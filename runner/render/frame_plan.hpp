// Which passes are drawn in which order, what each of them reads, and what their targets must be. Pure: what
// the scene says and what the driver kept decide.
#pragma once

#include "gl/program.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <vector>

namespace tidemark::render {

/// What a scene does not need and gets all the same, to measure what leaving it out saves. The picture stays.
struct Extras {
    bool passes = false;          ///< are drawn although nobody reads them
    bool channels = false;        ///< are loaded although the program reads nothing of them
    bool mipmaps = false;         ///< of buffers, although nobody filters between them
    bool second_textures = false; ///< of buffers that do not read themselves
    bool uniforms = false;        ///< are handed over although the program has none of that name
    bool unchanged = false;       ///< passes are drawn although they read what they read the last time
};

/// Whether a read of a pass sees what was drawn in this frame or in the last one.
enum class FrameRef { current, previous };

struct PlannedPass {
    size_t pass = 0;               ///< index into Scene::passes
    std::vector<int> channels;     ///< those that need a texture, ascending
    bool keyboard_helpers = false; ///< reads the texture of `#iKeyboard`
};

/// What the output of a pass is kept in.
struct TargetPlan {
    bool two_textures = false; ///< the pass reads its own last frame while it draws, or keeps pixels of it
    bool mipmaps = false;      ///< some reader filters between mipmaps
    int carried = 0;           ///< of its textures, the latest first, so many does the next frame see
};

struct FramePlan {
    std::vector<PlannedPass> passes; ///< in the order of drawing; none that nobody needs
    std::vector<TargetPlan> targets; ///< one for each pass of the scene
    bool feedback = false;           ///< a frame depends on the one before it

    const PlannedPass* find(size_t pass) const;
};

/// Whether a program of that pass needs the texture of channel `number`: it samples it, or asks for its size
/// or its time, which only the texture knows. Nobody needs the picture of a pass to know how large it is.
bool needs_texture(const scene::ChannelInput& input, int number, const gl::Reflection& reflection);

/// ShaderToy's order: a pass reads what stands before it in this frame's state, itself and what stands behind
/// it in the last frame's.
FrameRef frame_ref(size_t reader, size_t source);

/// Whether a frame may depend on the one before it, as far as the channels tell without the texts.
bool may_have_feedback(const scene::Scene& scene);

/// The passes that `shown` needs, itself included. `reflections` has one entry for each pass of the scene;
/// those without (not linked) are not drawn. `discarding`: the passes whose texts say `discard`, which leaves
/// what the target held: of a buffer, as on the site, the frame before the last, because its two textures
/// take turns; of Image the last one.
FramePlan plan_frame(const scene::Scene& scene, const std::vector<std::optional<gl::Reflection>>& reflections,
                     size_t shown, const Extras& extras = {}, const std::vector<size_t>& discarding = {});

} // namespace tidemark::render
