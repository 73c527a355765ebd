// Links a pass of a scene, trying the dialects of GLSL that its text may be written in.
#pragma once

#include "base/error.hpp"
#include "base/extent.hpp"
#include "media/image.hpp"
#include "render/channel_textures.hpp"
#include "render/frame_plan.hpp"
#include "render/frame_state.hpp"
#include "render/gl_program.hpp"
#include "render/pass_state.hpp"
#include "scene/host_uniforms.hpp"
#include "scene/scene.hpp"
#include "shader/promote.hpp"
#include "shader/shader_source.hpp"
#include "shader/specialise.hpp"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::render {

struct LinkedPass {
    gl::Program program;
    /// Dialect that linked. Its channel kinds differ from the scene's if the text samples a cube or a volume
    /// in a channel that the scene leaves unspecified.
    glsl::Dialect dialect;
    std::vector<glsl::KeptHash> hashes{}; ///< hashes kept in floats in a promoted program
    glsl::LeftOut left_out{};
    bool discards = false; ///< as in glsl::PassReading
};

/// Compile options of a pass.
struct LinkOptions {
    glsl::Precision precision = glsl::Precision::single;
    glsl::Specialise specialise = glsl::Specialise::nothing;
    bool tiled = false;            ///< as in glsl::Dialect
    bool marks_non_finite = false; ///< as in glsl::Dialect
    bool keeps_alpha = false;      ///< as in glsl::Dialect
};

/// Links the pass. Errors have the authors' own files and lines. If the specialised text does not link, the
/// whole text is linked.
Result<LinkedPass> link_pass(const scene::Scene& scene, const scene::Pass& pass, const LinkOptions& options);

// Maps the active uniforms of a linked program to the rows of `scene::k_host_uniforms`, channels' structs and
// knobs, once, and computes their values for each frame.

class UniformTable {
public:
    UniformTable() = default;
    /// The scene's knobs, and whether other hosts' names count: on ShaderToy a uniform `time` is zero, and so
    /// it is here.
    struct Names {
        const std::vector<scene::Knob>& knobs;
        bool other_hosts = false; ///< accepts names of the VS Code extension, glslsandbox.com and glslViewer
    };
    /// `absent_too`: also sets uniforms that the program does not have, to measure the cost.
    UniformTable(const gl::Reflection& reflection, const Names& names, bool absent_too = false);

    size_t size() const { return entries_.size(); }

    /// Computes the values of the active uniforms.
    UniformValues values(const FrameInputs& inputs, Extent resolution, const ChannelFacts& channels,
                         const std::vector<scene::Knob>& knobs) const;
    /// Receives a uniform, its numbers, and how many of them an array element has.
    using Take = std::function<void(const gl::Uniform&, std::span<const double>, size_t width)>;
    void hand_over(const UniformValues& values, const Take& take) const;
    void upload(const gl::Program& program, const UniformValues& values) const;

    /// Returns whether a uniform may change in the next frame without user input.
    bool follows_clock() const;

private:
    enum class Source {
        host,
        struct_size,   ///< iChN.size, iChannel[N].resolution
        struct_time,   ///< iChN.time, iChannel[N].time
        struct_loaded, ///< iChN.loaded
        knob
    };
    /// Returns the source of a member of that channel's struct; nothing for other uniforms.
    static std::optional<Source> struct_member(std::string_view name, size_t channel);

    struct Entry {
        gl::Uniform uniform;
        Source source;
        size_t index = 0; ///< of the row, the knob or the channel

        const scene::HostUniform& row() const { return scene::k_host_uniforms[index]; }
    };
    static UniformNumbers host_value(const Entry& entry, const FrameInputs& inputs, Extent resolution,
                                     const ChannelFacts& channels);
    std::vector<Entry> entries_;
};

// A scene with compiled programs and the plan of a frame. Draws nothing and owns no picture.

struct RenderOptions {
    Extent extent{640, 360};
    /// u8 draws Image into RGBA8, so that a picture holds what GL itself shows; f32 draws it into RGBA32F.
    /// Buffers are always RGBA32F, cubemap passes RGBA16F.
    image::SampleType samples = image::SampleType::u8;
    std::string pass{}; ///< pass to show; empty: Image
    /// Does not change the formats of textures and targets: a promoted pass reads and writes floats and
    /// computes in doubles in between.
    glsl::Precision precision = glsl::Precision::single;
    /// Above `unreachable`, knobs are fixed at compile time.
    glsl::Specialise specialise = glsl::Specialise::nothing;
    Extras extras{};
    /// Tile size for drawing the shown pass in tiles, if no pass reads it: `draw` then skips it, and
    /// `draw_tile` draws it.
    std::optional<Extent> tile{};
    /// Marks non-finite pixels in the bytes of Image (image::take_non_finite). Ignored if a pass reads Image.
    bool marks_non_finite = false;
    /// Keeps the alpha that the text of Image writes, instead of 1, also for passes that read Image.
    bool keeps_alpha = false;
};

struct CompiledPass {
    LinkedPass linked;
    UniformTable uniforms;
};

class CompiledScene {
public:
    /// Compiles the passes that the shown one may need. Compile errors have the authors' own files and lines.
    static Result<CompiledScene> create(scene::Scene scene, const RenderOptions& options);

    const scene::Scene& scene() const { return scene_; }
    /// Replaces the values of the scene's knobs, in their order.
    void turn(std::vector<scene::Knob> knobs) { scene_.knobs = std::move(knobs); }

    /// Options as given, but `tile` is set only if the shown pass is drawn in tiles.
    const RenderOptions& options() const { return options_; }
    const FramePlan& plan() const { return plan_; }
    /// Returns the index of the shown pass.
    size_t shown() const { return shown_; }
    /// Returns a pass of the plan.
    const CompiledPass& operator[](size_t pass) const { return *passes_[pass]; }

    UniformTable::Names names_of(size_t pass, const glsl::Dialect& dialect) const;
    /// Returns the texture format of a pass that is not a cubemap pass.
    GLenum format_of(size_t pass) const;
    bool can_be_tiled() const;

private:
    CompiledScene(scene::Scene scene, RenderOptions options)
        : scene_(std::move(scene)), options_(std::move(options)) {}
    Result<void> choose_pass();
    Result<void> compile();
    std::vector<bool> reachable() const;

    scene::Scene scene_;
    RenderOptions options_;
    size_t shown_ = 0;
    std::vector<std::optional<CompiledPass>> passes_; ///< one per pass of the scene; empty: not needed
    FramePlan plan_;
};

} // namespace tidemark::render
