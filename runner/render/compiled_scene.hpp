// A scene whose texts the driver has compiled: its programs, and the plan of a frame. Draws nothing and owns
// no picture.
#pragma once

#include "base/result.hpp"
#include "gl/program.hpp"
#include "glsl/dialect.hpp"
#include "glsl/double/promote.hpp"
#include "glsl/specialise/specialise.hpp"
#include "image/image.hpp"
#include "render/frame_plan.hpp"
#include "render/link_pass.hpp"
#include "render/uniform_table.hpp"
#include "scene/scene.hpp"

#include <optional>
#include <string>
#include <vector>

namespace tidemark::render {

struct RenderOptions {
    Extent extent{640, 360};
    /// u8 draws Image into RGBA8, so that a picture holds what GL itself shows; f32 into RGBA32F. Buffers are
    /// always RGBA32F, cubemap passes RGBA16F.
    image::SampleType samples = image::SampleType::u8;
    std::string pass{}; ///< the pass to show; empty: Image
    /// Textures and targets hold what they always hold: in a promoted scene a pass reads floats and writes
    /// floats, and computes in doubles between.
    glsl::Precision precision = glsl::Precision::single;
    /// Beyond `unreachable` its knobs cannot be turned.
    glsl::Specialise specialise = glsl::Specialise::nothing;
    Extras extras{};
    /// Draws the shown pass tile by tile into a target of this size, where nobody reads its picture: then
    /// `draw` leaves it out, and `draw_tile` draws it.
    std::optional<Extent> tile{};
    /// Bytes of Image tell which pixels were not finite: image::take_non_finite. Not where a pass reads it.
    bool marks_non_finite = false;
    /// Image has the alpha that its text gives it, instead of 1, also where a pass reads it.
    bool keeps_alpha = false;
};

struct CompiledPass {
    LinkedPass linked;
    UniformTable uniforms;
};

class CompiledScene {
public:
    /// Compiles the passes that the shown one may need. The error of a scene that does not compile has the
    /// authors' own files and lines.
    static Result<CompiledScene> create(scene::Scene scene, const RenderOptions& options);

    const scene::Scene& scene() const { return scene_; }
    /// Other values for the scene's knobs, in their order.
    void turn(std::vector<scene::Knob> knobs) { scene_.knobs = std::move(knobs); }

    /// As asked for; a tile where the shown pass is drawn in tiles, and nowhere else.
    const RenderOptions& options() const { return options_; }
    const FramePlan& plan() const { return plan_; }
    /// The index of the pass that is shown.
    size_t shown() const { return shown_; }
    /// One in the plan.
    const CompiledPass& operator[](size_t pass) const { return *passes_[pass]; }

    UniformTable::Names names_of(size_t pass, const glsl::Dialect& dialect) const;
    /// Of the target that a pass is drawn into.
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
    std::vector<std::optional<CompiledPass>> passes_; ///< one for each of the scene's; none: not needed
    FramePlan plan_;
};

} // namespace tidemark::render
