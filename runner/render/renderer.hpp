// Draws a scene. The only object that does, for a window and for a file alike: give it FrameInputs, get
// pixels. A context must be current, and stay so as long as the Renderer lives.
#pragma once

#include "base/result.hpp"
#include "gl/program.hpp"
#include "glsl/dialect.hpp"
#include "glsl/double/promote.hpp"
#include "glsl/specialise/specialise.hpp"
#include "image/image.hpp"
#include "render/bound_channel.hpp"
#include "render/channel_textures.hpp"
#include "render/frame_inputs.hpp"
#include "render/frame_plan.hpp"
#include "render/last_drawing.hpp"
#include "render/pass_target.hpp"
#include "render/tile_grid.hpp"
#include "render/uniform_table.hpp"
#include "scene/scene.hpp"

#include <array>
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
};

/// What a frame takes, in things that can be counted.
struct FrameWork {
    size_t draws = 0;    ///< in the last frame
    size_t uniforms = 0; ///< handed over
    size_t channels = 0; ///< with a texture
    size_t texture_bytes = 0;
    size_t lines_removed = 0; ///< of the texts that were compiled for it

    bool operator==(const FrameWork&) const = default;
};

class Renderer {
public:
    /// Compiles the passes that the shown one may need, loads what they read, makes the targets. The error of
    /// a scene that does not compile has the authors' own files and lines.
    static Result<Renderer> create(scene::Scene scene, const RenderOptions& options);

    /// Has the driver finish what it puts off until the first draw, without drawing anything.
    void warm_up(const FrameInputs& inputs);

    /// One frame. Buffers keep their content for the next one. A pass that reads what it read the last time
    /// is not drawn again.
    void draw(const FrameInputs& inputs);
    /// How many passes have been drawn in all frames so far.
    size_t passes_drawn() const { return passes_drawn_; }
    /// Whether the next frame may be another one although nobody turns, moves or presses anything. Buffers
    /// that are not at rest yet do not count.
    bool follows_clock() const;

    /// Goes on into the frame as far as `pass`: those in front of it are drawn, and draw_stand_in sees what
    /// `pass` would see. Buffers have made that step then: where there is feedback, `reset` comes next, no
    /// `draw`.
    void advance_to(size_t pass, const FrameInputs& inputs);
    /// Draws what `pass` is about to draw by another program, made from a text of the same dialect, into a
    /// target of any size; uniforms are the pass's. Of a cubemap, one face. The pass itself stays undrawn.
    void draw_stand_in(size_t pass, const gl::Program& program, const FrameInputs& inputs,
                       const gl::RenderTarget& into, int face = 0) const;

    /// The tiles of the shown pass; nothing where it is drawn whole.
    std::optional<TileGrid> tiles() const;
    /// One tile, after the `draw` of the same frame, and its pixels in their place in `band`: a picture of
    /// the whole width whose bottom row is the tile's. The same bytes as in a picture drawn whole.
    void draw_tile(const FrameInputs& inputs, const Tile& tile, image::Image& band) const;

    /// Buffers back to zero, as before frame 0.
    void reset();

    /// Buffers take over what they hold in another Renderer of the scene as it was before: each from the pass
    /// of its name. The two may live in two contexts that share their textures; the other one is done
    /// drawing.
    void continue_from(const Renderer& before);

    /// The pixels of the shown pass, drawn whole. A buffer that is shown in bytes is clamped; of a cube, face
    /// +x.
    image::Image read_back() const { return read_back(shown_); }
    /// The faces of a shown cubemap pass, +x -x +y -y +z -z.
    std::array<image::Image, 6> read_back_cube() const;

    /// The pixels of a pass in the plan, a cubemap's +x.
    image::Image read_back(size_t pass) const;

    /// Other values for the scene's knobs, in their order, from the next frame on.
    void turn(std::vector<scene::Knob> knobs) { scene_.knobs = std::move(knobs); }

    /// The last picture of any pass in the plan, in floats.
    image::Image read_floats(size_t pass, int face = 0) const;

    /// Targets of another size, buffers keeping the overlap; fails (ErrorCode::usage) beyond the driver's
    /// limit and leaves the old ones.
    Result<void> resize(Extent extent);

    FrameWork work() const;
    Extent extent() const { return extent_; }
    image::SampleType samples() const { return samples_; }
    const gl::RenderTarget& target() const { return targets_[shown_].latest(); }
    const scene::Scene& scene() const { return scene_; }
    const scene::Pass& shown_pass() const { return scene_.passes[shown_]; }
    size_t shown_index() const { return shown_; }
    const FramePlan& plan() const { return plan_; }
    /// The program of a pass in the plan.
    const gl::Program& program(size_t pass) const { return *passes_[pass].program; }
    glsl::Precision precision() const { return precision_; }
    /// What a pass in the plan leaves in floats although the scene is promoted.
    const std::vector<glsl::KeptHash>& kept_hashes(size_t pass) const { return passes_[pass].hashes; }
    /// Of the text of a pass in the plan.
    const glsl::LeftOut& left_out(size_t pass) const { return passes_[pass].left_out; }
    /// What it was linked as.
    const glsl::Dialect& dialect(size_t pass) const { return passes_[pass].dialect; }

private:
    struct CompiledPass {
        std::optional<gl::Program> program; ///< none: not needed
        glsl::Dialect dialect;
        UniformTable uniforms;
        std::vector<BoundChannel> channels;
        std::vector<glsl::KeptHash> hashes;
        LastDrawing drawn;
        glsl::LeftOut left_out;
        bool discards = false; ///< a pixel may keep what an earlier frame drew there
    };

    Result<void> choose_pass(const std::string& name);
    std::vector<bool> reachable() const;
    bool can_be_tiled() const;
    Result<void> compile();
    Result<void> bind_channels();
    const gl::Texture& texture_of(const BoundChannel& channel) const;
    Result<void> make_targets();
    Result<PassTarget> make_target(size_t pass) const;
    bool has_own_size(size_t pass) const;
    GLenum format_of(size_t pass) const;

    void draw_pass(size_t pass, const FrameInputs& inputs);
    UniformValues uniforms_of(size_t pass, const UniformTable& table, const FrameInputs& inputs,
                              Extent extent) const;
    Edition edition_of(const BoundChannel& channel) const;
    void bind_textures(const CompiledPass& pass) const;
    void draw_tile(const FrameInputs& inputs, const Tile& tile) const;
    void draw_face(const gl::Program& program, const gl::RenderTarget& into, Extent extent) const;
    ChannelFacts facts_of(const CompiledPass& pass, scene::PassKind kind, const FrameInputs& inputs) const;

    scene::Scene scene_;
    Extent extent_;
    image::SampleType samples_ = image::SampleType::u8;
    glsl::Precision precision_ = glsl::Precision::single;
    Extras extras_;
    glsl::Specialise specialise_ = glsl::Specialise::nothing;
    size_t shown_ = 0;
    std::optional<Extent> tile_; ///< of the shown pass
    bool marks_non_finite_ = false;
    gl::VertexArrayHandle no_vertices_;
    std::vector<CompiledPass> passes_; ///< one for each of the scene's
    FramePlan plan_;
    ChannelTextures textures_;
    std::vector<PassTarget> targets_; ///< one for each of the scene's; empty where nothing is drawn
    size_t passes_drawn_ = 0;
    size_t draws_in_frame_ = 0; ///< the last one
    bool within_frame_ = false; ///< advance_to was there
};

} // namespace tidemark::render
