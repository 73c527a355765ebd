// How the drawn picture is shown: render scale, pictures of passes, magnifier, frozen frame, marks.
//
// Rendered pixels per window pixel along a side: a power of two.
#pragma once

#include "base/extent.hpp"
#include "host/input_script.hpp"
#include "host/moment.hpp"
#include "host/overlay_model.hpp"
#include "host/presets.hpp"
#include "render/buffer_views.hpp"
#include "render/renderer.hpp"
#include "window/inspection.hpp"
#include "window/lens_view.hpp"
#include "window/recorder.hpp"

#include <compare>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::window {

class RenderScale {
public:
    RenderScale() = default; ///< 1: renders each window pixel
    /// Lists the scales from the smallest to the largest.
    static std::vector<RenderScale> all();
    /// Finds the scale of that `name`.
    static std::optional<RenderScale> named(std::string_view name);

    /// Returns `1/4`, `1` or `2`, for example.
    std::string name() const;
    /// Returns the size to render for a window of that size; at least one pixel a side.
    Extent drawn(Extent window) const;
    /// Returns the scale `steps` powers of two higher, or lower if negative, within the range.
    RenderScale stepped(int steps) const;
    /// Returns the number of steps from `other` to this scale.
    int steps_from(RenderScale other) const { return exponent_ - other.exponent_; }

    auto operator<=>(const RenderScale&) const = default;

private:
    explicit RenderScale(int exponent) : exponent_(exponent) {}

    int exponent_ = 0;
};

// Chooses the render scale that holds a frame rate, from the time of each frame. The scale falls soon, rises
// late, and ignores a few slow frames.

class AdaptiveScale {
public:
    explicit AdaptiveScale(double fps) : budget_(1000 / fps) {}

    /// Returns the scale of the next frame after a frame in `scale` took that long.
    RenderScale after_frame(RenderScale scale, double milliseconds);
    /// Discards all measurements; for changes after which frames may take a different time.
    void forget();

private:
    std::optional<RenderScale> lower(RenderScale scale) const;
    std::optional<RenderScale> higher(RenderScale scale);

    double budget_;                        ///< milliseconds per frame
    std::deque<double> recent_;            ///< times of frames in the current scale, the newest last
    double growth_ = k_pixels;             ///< factor of a frame's time for twice as many pixels along a side
    std::optional<double> before_step_up_; ///< milliseconds; set while the last step up may still be undone

    static constexpr double k_pixels = 4;
};

// The textures that passes draw and read, as flat pictures for the overlay: cubes unfolded, a slice of a
// volume, the large one with its view settings. Draws no pass; does nothing while the controls are hidden.

/// The pictures of one Renderer, in its context.
class PassPictures {
public:
    /// The large picture and its view settings, into which the automatic exposure is written.
    struct Large {
        std::optional<size_t> index{}; ///< index into `fields`; beyond the end: none
        overlay::LookField look{};
        Extent window{};
    };

    /// Returns the outputs of passes, then their inputs. `floats` and `inputs` give the shown pass in floats.
    std::vector<overlay::PictureField> fields(const render::Renderer& renderer, const PassCosts& costs,
                                              Large& large, render::ShownFloats& floats,
                                              const render::FrameInputs& inputs);

private:
    const gl::Texture* flat(const gl::Texture& picture, int face, std::optional<int> slice);
    const gl::Texture& looked_at(const gl::Texture& picture, overlay::LookField& look);

    std::map<GLuint, render::FlatView> flat_{}; ///< views of the textures that are not flat
    std::optional<render::PictureLook> look_{};
};

/// Returns a texture of a picture of three or four channels of bytes.
gl::Texture texture_of(const image::Image& picture);

// The magnifier of the window. Reads the pixels around the pointer, only while it is open.

class Magnifier {
public:
    void toggle() { open_ = !open_; }
    bool is_open() const { return open_; }
    /// Follows the pointer. Returns whether the magnifier must be shown again.
    bool follow(const host::InputEvent& event);

    /// Returns the pixel under the pointer, for a picture that fills the window.
    Rectangle pixel(Extent picture, Extent window) const;
    /// Returns the magnifier of the frame on show, which was drawn with `inputs`. Returns nothing while it is
    /// closed or the pointer is outside the window.
    std::optional<overlay::MagnifierField> field(const render::Renderer& renderer,
                                                 const render::FrameInputs& inputs, Extent window,
                                                 render::ShownFloats& floats) const;

private:
    bool open_ = false;
    host::PointerPosition pointer_{};
};

// How the drawn picture is shown: its scale, a frozen frame, marks, the magnifier, the large picture of the
// controls. The objects that draw these views live in the context of the scene on show.

/// A frame that stays on show while the scene and its time go on.
struct Frozen {
    gl::RenderTarget target; ///< in the context of the scene on show
    KeptPicture picture;
    host::Moment moment;
};

class PictureView {
public:
    explicit PictureView(RenderScale scale) : scale_(scale) {}

    // Scale

    RenderScale scale() const { return scale_; }
    void set_scale(RenderScale scale) { scale_ = scale; }
    /// Returns the size of the drawn picture for a window of that size.
    Extent drawn(Extent window) const { return scale_.drawn(window); }
    /// Converts an event's place in the window to pixels of the drawn picture.
    host::ControlEvent in_picture(const host::ControlEvent& event, Extent window) const;
    bool adapts() const { return adaptive_.has_value(); }
    /// Adapts the scale to hold a frame rate; none: the scale is constant.
    void adapt_to(std::optional<double> fps);
    /// Returns the scale for the next frame after one that took that long.
    RenderScale scale_after(double milliseconds);
    /// Discards measured times; for changes after which frames may take a different time.
    void forget_times();

    // Freeze

    /// Shows that frame instead of later ones; none: shows them again.
    void freeze(std::optional<Frozen> frame) { frozen_ = std::move(frame); }
    const Frozen* frozen() const { return frozen_ ? &*frozen_ : nullptr; }

    // Marks

    void toggle_marks();
    bool shows_marks() const { return marks_shown_; }
    /// Returns the texture that the marks are drawn from, after drawing the shown pass once more as a whole;
    /// null: no marks.
    const gl::Texture* marked(const render::Renderer& renderer, const render::FrameInputs& inputs);
    /// Draws them over a window of that size, after `marked`.
    void draw_marks(const gl::Texture& picture, Extent window) const { marks_->draw(picture, window); }

    // Magnifier

    void toggle_magnifier();
    bool magnifies() const { return magnifier_.is_open(); }
    /// Follows the pointer. Returns whether magnifier or legend must be shown again.
    bool follow(const host::InputEvent& event) { return magnifier_.follow(event) || lens_.on(); }
    /// Returns the pixel under the pointer.
    Rectangle pixel(Extent picture, Extent window) const { return magnifier_.pixel(picture, window); }
    std::optional<overlay::MagnifierField> magnifier(const render::Renderer& renderer,
                                                     const render::FrameInputs& inputs, Extent window) {
        return magnifier_.field(renderer, inputs, window, floats());
    }

    // Lenses

    LensView& lens() { return lens_; }
    const LensView& lens() const { return lens_; }
    /// Returns the legend, with the number under the pointer.
    std::optional<overlay::LensField> legend(Extent window) const;

    // The pictures of passes and inputs

    /// Shows the picture of that index large; none: the scene's own.
    void show_large(std::optional<size_t> index) { large_ = index; }
    /// Shows a picture large by its number, from 1; 0, or the same number again: the scene's own.
    void choose(int number);
    std::optional<size_t> large() const { return large_; }
    void look(const overlay::LookField& look) { look_ = look; }
    /// Adds the pictures and the large one to the model.
    void add_pictures(overlay::Model& model, const render::Renderer& renderer, const PassCosts& costs,
                      const render::FrameInputs& inputs, Extent window);
    /// Adds the thumbnails of the views to the model.
    void add_thumbnails(overlay::Model& model, const std::shared_ptr<const std::vector<host::Preset>>& views);
    /// Drops what only `add_pictures` needs, when the controls are closed.
    void hide_pictures() { pictures_.reset(); }

    // The context of the scene on show

    /// Deletes the objects in the context, which is current. The frozen picture stays.
    void leave_context();
    /// Enters another context, which is current.
    void enter_context();

private:
    render::ShownFloats& floats();
    void forget_objects();

    RenderScale scale_;
    std::optional<AdaptiveScale> adaptive_{}; ///< none: the scale is constant
    std::optional<Frozen> frozen_{};
    bool marks_shown_ = false;
    Magnifier magnifier_{};
    LensView lens_{};
    std::optional<size_t> large_{};               ///< index into the overlay's pictures
    overlay::LookField look_{};                   ///< how that one is viewed
    std::optional<render::ShownFloats> floats_{}; ///< created on demand
    std::optional<render::NumberMarks> marks_{};  ///< likewise
    std::optional<PassPictures> pictures_{};      ///< likewise, while the controls are open
    std::shared_ptr<const std::vector<host::Preset>> thumbnails_of_{}; ///< the views that `thumbnails_` shows
    std::vector<std::optional<gl::Texture>> thumbnails_{};
};

} // namespace tidemark::window
