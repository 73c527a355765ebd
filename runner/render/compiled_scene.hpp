// Links a pass of a scene, trying the dialects of GLSL that its text may be written in.
#pragma once

#include "base/error.hpp"
#include "media/image.hpp"
#include "render/frame_plan.hpp"
#include "render/gl_program.hpp"
#include "render/uniform_table.hpp"
#include "scene/scene.hpp"
#include "shader/promote.hpp"
#include "shader/shader_source.hpp"
#include "shader/specialise.hpp"

#include <optional>
#include <string>
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
