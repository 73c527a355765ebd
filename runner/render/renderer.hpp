// Draws a scene, for windows and files alike: takes FrameInputs and gives pixels. No other object draws
// scenes. A context must be current as long as the Renderer lives.
#pragma once

#include "base/error.hpp"
#include "media/image.hpp"
#include "render/channel_textures.hpp"
#include "render/compiled_scene.hpp"
#include "render/frame_plan.hpp"
#include "render/frame_state.hpp"
#include "render/gl_program.hpp"
#include "render/gl_sync.hpp"
#include "render/pass_state.hpp"
#include "render/picture_parts.hpp"
#include "scene/scene.hpp"

#include <array>
#include <optional>
#include <vector>

namespace tidemark::render {

/// Countable cost of a frame.
struct FrameWork {
    size_t draws = 0;    ///< in the last frame
    size_t uniforms = 0; ///< set per frame
    size_t channels = 0; ///< with a texture
    size_t texture_bytes = 0;
    size_t lines_removed = 0; ///< from the compiled texts

    bool operator==(const FrameWork&) const = default;
};

/// GPU time of a pass in a frame, by the driver's timer.
struct PassTimer {
    size_t pass;
    gl::ElapsedTime time;
};

class Renderer {
public:
    /// Compiles the passes that the shown one may need, loads their inputs and makes the targets. Compile
    /// errors have the authors' own files and lines.
    static Result<Renderer> create(scene::Scene scene, const RenderOptions& options);

    /// Makes the driver finish its deferred work before the first draw, without drawing anything.
    void warm_up(const FrameInputs& inputs);

    /// Draws one frame. Buffers keep their content for the next one. A pass whose inputs are unchanged is
    /// skipped. Appends a timer for each drawn pass to `timers`.
    void draw(const FrameInputs& inputs, std::vector<PassTimer>* timers = nullptr);
    /// Returns how many passes have been drawn in all frames so far.
    size_t passes_drawn() const { return passes_drawn_; }
    /// Returns whether the next frame may differ without user input. Ignores buffers that are still changing.
    bool follows_clock() const;

    /// Returns the tiles of the shown pass; nothing when it is drawn whole.
    std::optional<TileGrid> tiles() const;
    /// Draws one tile, after the `draw` of the same frame, and reads it into its place in `band`: a picture
    /// of the whole width whose bottom row is the tile's. The bytes equal those of a picture drawn whole.
    /// `offset`: shift of the sample from the pixel centres, in pixels.
    void draw_tile(const FrameInputs& inputs, const Tile& tile, image::Image& band,
                   glm::dvec2 offset = {}) const;

    /// Returns whether `draw_again` reproduces the shown picture: no pass reads it, and it reads nothing that
    /// was drawn after it.
    bool can_draw_again() const { return compiled_.can_be_tiled(); }
    /// Draws the shown pass again, after the `draw` of the same inputs, into a target of another format,
    /// within the scissor box.
    void draw_again(const FrameInputs& inputs, const gl::RenderTarget& into) const;

    /// Clears all buffers, as before frame 0.
    void reset();

    /// Returns the textures that the next frame reads of this one.
    BufferState buffer_state() const;
    /// Restores the buffers of `state`. Returns false and changes nothing when it is from another scene or
    /// size.
    bool restore(const BufferState& state);

    /// Copies the buffers of another Renderer of an earlier version of the scene, matching passes by name.
    /// The two may use two contexts that share textures; `before` must have finished drawing.
    void continue_from(const Renderer& before);

    /// Reads the pixels of the shown pass, drawn whole. A buffer read as bytes is clamped; of a cube, face +x
    /// is read.
    image::Image read_back() const { return read_back(shown_index()); }
    /// Reads the faces of a shown cubemap pass, +x -x +y -y +z -z.
    std::array<image::Image, 6> read_back_cube() const;

    /// Reads the pixels of a pass in the plan; of a cubemap, +x.
    image::Image read_back(size_t pass) const;

    /// Starts an asynchronous read of the shown pass; later drawing does not affect it. Returns false when
    /// the driver has no memory for it.
    bool read_ahead(gl::PixelRing& ring) const;
    /// Returns the oldest pending picture, as `read_back` would have returned it at its `read_ahead`.
    image::Image take(gl::PixelRing& ring) const;

    /// Replaces the values of the scene's knobs, in their order, from the next frame on.
    void turn(std::vector<scene::Knob> knobs) {
        compiled_.turn(std::move(knobs));
        ++changes_;
    }

    /// Reads the last picture of any pass in the plan as floats.
    image::Image read_floats(size_t pass, int face = 0) const;

    /// Resizes the targets; buffers keep the overlap. Fails (ErrorCode::usage) beyond the driver's limit and
    /// then keeps the old ones.
    Result<void> resize(Extent extent);

    FrameWork work() const;
    Extent extent() const { return extent_; }
    image::SampleType samples() const { return compiled_.options().samples; }
    const gl::RenderTarget& target() const { return target_of(shown_index()); }
    /// Returns the last picture of a pass in the plan.
    const gl::RenderTarget& target_of(size_t pass) const { return passes_[pass].target.latest(); }
    const scene::Scene& scene() const { return compiled_.scene(); }
    const scene::Pass& shown_pass() const { return scene().passes[shown_index()]; }
    size_t shown_index() const { return compiled_.shown(); }
    const FramePlan& plan() const { return compiled_.plan(); }
    /// Returns the program of a pass in the plan.
    const gl::Program& program(size_t pass) const { return compiled_[pass].linked.program; }
    glsl::Precision precision() const { return compiled_.options().precision; }
    /// Returns how far the texts are specialised.
    glsl::Specialise specialised() const { return compiled_.options().specialise; }
    /// Returns the hashes that a pass in the plan keeps in floats in a promoted scene.
    const std::vector<glsl::KeptHash>& kept_hashes(size_t pass) const {
        return compiled_[pass].linked.hashes;
    }
    /// Returns the specialisation result of a pass in the plan.
    const glsl::LeftOut& left_out(size_t pass) const { return compiled_[pass].linked.left_out; }
    /// Returns the dialect in which a pass in the plan was linked.
    const glsl::Dialect& dialect(size_t pass) const { return compiled_[pass].linked.dialect; }
    UniformTable::Names names_of(size_t pass) const { return compiled_.names_of(pass, dialect(pass)); }
    /// Computes the values of the uniforms in `table` for drawing a pass of the plan in that extent.
    UniformValues uniforms_of(size_t pass, const UniformTable& table, const FrameInputs& inputs,
                              Extent extent) const;

    /// Returns the current texture at a unit of a pass in the plan; null if it reads nothing there.
    const gl::Texture* texture_at(size_t pass, int unit) const;

private:
    friend class PassPreview;  ///< draws a frame up to a pass
    friend class FrameInParts; ///< draws passes apart and exchanges the pictures when all are complete
    /// The inputs and the output of a pass.
    struct DrawnPass {
        std::vector<BoundChannel> channels;
        PassTarget target; ///< empty if the pass is not drawn
        LastDrawing drawn;
    };

    explicit Renderer(CompiledScene compiled);
    Result<void> make_targets();
    Result<PassTarget> make_target(size_t pass) const;
    Result<void> bind_channels();
    bool is_cube(size_t pass) const { return scene().passes[pass].kind == scene::PassKind::cubemap; }
    bool is_tiled(size_t pass) const { return compiled_.options().tile && pass == compiled_.shown(); }
    bool has_own_size(size_t pass) const;

    void draw_pass(size_t pass, const FrameInputs& inputs);
    std::optional<PassInputs> changed_inputs(size_t pass, const FrameInputs& inputs) const;
    void prepare(size_t pass, const UniformValues& uniforms) const;
    void draw_face(size_t pass, int face, const gl::RenderTarget& into) const;
    int faces_of(size_t pass) const { return is_cube(pass) ? 6 : 1; }
    void draw_before(size_t pass, const FrameInputs& inputs);
    void draw_substitute(size_t pass, const gl::Program& program, const FrameInputs& inputs,
                         const gl::RenderTarget& into, int face) const;
    const gl::Program& prepare_shown(const FrameInputs& inputs) const;
    void draw_tile(const FrameInputs& inputs, const Tile& tile, glm::dvec2 offset) const;
    void draw_face(const gl::Program& program, const gl::RenderTarget& into, Extent extent) const;
    ChannelFacts facts_of(size_t pass, const FrameInputs& inputs) const;
    void bind_textures(size_t pass) const;
    const gl::Texture& texture_of(const BoundChannel& channel) const;
    Generation edition_of(const BoundChannel& channel) const;

    CompiledScene compiled_;
    Extent extent_;
    gl::VertexArrayHandle no_vertices_;
    ChannelTextures textures_;
    std::vector<DrawnPass> passes_; ///< one per pass of the scene
    size_t passes_drawn_ = 0;
    size_t changes_ = 0;        ///< number of changes to its pictures, of any kind
    size_t draws_in_frame_ = 0; ///< in the last frame
};

} // namespace tidemark::render
