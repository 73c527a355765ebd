// Draws a scene. The only object that does, for a window and for a file alike: give it FrameInputs, get
// pixels. A context must be current, and stay so as long as the Renderer lives.
#pragma once

#include "base/result.hpp"
#include "gl/elapsed_time.hpp"
#include "gl/pixel_ring.hpp"
#include "gl/program.hpp"
#include "image/image.hpp"
#include "render/bound_channel.hpp"
#include "render/buffer_state.hpp"
#include "render/channel_textures.hpp"
#include "render/compiled_scene.hpp"
#include "render/frame_inputs.hpp"
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

/// What a frame takes, in things that can be counted.
struct FrameWork {
    size_t draws = 0;    ///< in the last frame
    size_t uniforms = 0; ///< handed over
    size_t channels = 0; ///< with a texture
    size_t texture_bytes = 0;
    size_t lines_removed = 0; ///< of the texts that were compiled for it

    bool operator==(const FrameWork&) const = default;
};

/// What a pass took in a frame, by the driver's timer.
struct PassTimer {
    size_t pass;
    gl::ElapsedTime time;
};

class Renderer {
public:
    /// Compiles the passes that the shown one may need, loads what they read, makes the targets. The error of
    /// a scene that does not compile has the authors' own files and lines.
    static Result<Renderer> create(scene::Scene scene, const RenderOptions& options);

    /// Has the driver finish what it puts off until the first draw, without drawing anything.
    void warm_up(const FrameInputs& inputs);

    /// One frame. Buffers keep their content for the next one. A pass that reads what it read the last time
    /// is not drawn again. Passes that are drawn are added to `timers`.
    void draw(const FrameInputs& inputs, std::vector<PassTimer>* timers = nullptr);
    /// How many passes have been drawn in all frames so far.
    size_t passes_drawn() const { return passes_drawn_; }
    /// Whether the next frame may be another one although nobody turns, moves or presses anything. Buffers
    /// that are not at rest yet do not count.
    bool follows_clock() const;

    /// The tiles of the shown pass; nothing where it is drawn whole.
    std::optional<TileGrid> tiles() const;
    /// One tile, after the `draw` of the same frame, and its pixels in their place in `band`: a picture of
    /// the whole width whose bottom row is the tile's. The same bytes as in a picture drawn whole. `offset`:
    /// from the middle of its pixels.
    void draw_tile(const FrameInputs& inputs, const Tile& tile, image::Image& band,
                   glm::dvec2 offset = {}) const;

    /// Whether `draw_again` gives the picture on show: nobody has read it, and it reads nothing that was
    /// drawn after it.
    bool can_draw_again() const { return compiled_.can_be_tiled(); }
    /// The shown pass once more, after the `draw` of the same inputs, into a target of another format; as far
    /// as the scissor box allows.
    void draw_again(const FrameInputs& inputs, const gl::RenderTarget& into) const;

    /// Buffers back to zero, as before frame 0.
    void reset();

    /// What the next frame reads of this one.
    BufferState buffer_state() const;
    /// Buffers as they were when `state` was taken; false, and nothing is changed, where it is of another
    /// scene or size.
    bool restore(const BufferState& state);

    /// Buffers take over what they hold in another Renderer of the scene as it was before: each from the pass
    /// of its name. The two may live in two contexts that share their textures; the other one is done
    /// drawing.
    void continue_from(const Renderer& before);

    /// The pixels of the shown pass, drawn whole. A buffer that is shown in bytes is clamped; of a cube, face
    /// +x.
    image::Image read_back() const { return read_back(shown_index()); }
    /// The faces of a shown cubemap pass, +x -x +y -y +z -z.
    std::array<image::Image, 6> read_back_cube() const;

    /// The pixels of a pass in the plan, a cubemap's +x.
    image::Image read_back(size_t pass) const;

    /// Begins to read the shown pass back; false where the driver has no memory for that. What is drawn from
    /// then on is not seen.
    bool read_ahead(gl::PixelRing& ring) const;
    /// The oldest that is on its way, as `read_back` would have given it then.
    image::Image take(gl::PixelRing& ring) const;

    /// Other values for the scene's knobs, in their order, from the next frame on.
    void turn(std::vector<scene::Knob> knobs) {
        compiled_.turn(std::move(knobs));
        ++changes_;
    }

    /// The last picture of any pass in the plan, in floats.
    image::Image read_floats(size_t pass, int face = 0) const;

    /// Targets of another size, buffers keeping the overlap; fails (ErrorCode::usage) beyond the driver's
    /// limit and leaves the old ones.
    Result<void> resize(Extent extent);

    FrameWork work() const;
    Extent extent() const { return extent_; }
    image::SampleType samples() const { return compiled_.options().samples; }
    const gl::RenderTarget& target() const { return target_of(shown_index()); }
    /// The last picture of a pass in the plan.
    const gl::RenderTarget& target_of(size_t pass) const { return passes_[pass].target.latest(); }
    const scene::Scene& scene() const { return compiled_.scene(); }
    const scene::Pass& shown_pass() const { return scene().passes[shown_index()]; }
    size_t shown_index() const { return compiled_.shown(); }
    const FramePlan& plan() const { return compiled_.plan(); }
    /// The program of a pass in the plan.
    const gl::Program& program(size_t pass) const { return compiled_[pass].linked.program; }
    glsl::Precision precision() const { return compiled_.options().precision; }
    /// How far its texts are specialised.
    glsl::Specialise specialised() const { return compiled_.options().specialise; }
    /// What a pass in the plan leaves in floats although the scene is promoted.
    const std::vector<glsl::KeptHash>& kept_hashes(size_t pass) const {
        return compiled_[pass].linked.hashes;
    }
    /// Of the text of a pass in the plan.
    const glsl::LeftOut& left_out(size_t pass) const { return compiled_[pass].linked.left_out; }
    /// What it was linked as.
    const glsl::Dialect& dialect(size_t pass) const { return compiled_[pass].linked.dialect; }
    UniformTable::Names names_of(size_t pass) const { return compiled_.names_of(pass, dialect(pass)); }
    /// What the uniforms of a table are told where a pass in the plan is drawn in that extent.
    UniformValues uniforms_of(size_t pass, const UniformTable& table, const FrameInputs& inputs,
                              Extent extent) const;

    /// What a pass in the plan reads at that unit, as it is now; none where it reads nothing there.
    const gl::Texture* texture_at(size_t pass, int unit) const;

private:
    friend class PassPreview;  ///< goes on into a frame, and no further
    friend class FrameInParts; ///< draws passes apart, and leaves their pictures when all are whole
    /// What is drawn of a pass, and what it is drawn from.
    struct DrawnPass {
        std::vector<BoundChannel> channels;
        PassTarget target; ///< empty where nothing is drawn
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
    std::vector<DrawnPass> passes_; ///< one for each of the scene's
    size_t passes_drawn_ = 0;
    size_t changes_ = 0;        ///< of its pictures, of whatever kind
    size_t draws_in_frame_ = 0; ///< the last one
};

} // namespace tidemark::render
