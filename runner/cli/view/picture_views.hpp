// The textures that passes draw and read, as flat pictures for the overlay: cubes unfolded, a slice of a
// volume, the large one with its view settings. Draws no pass; does nothing while the controls are hidden.
#pragma once

#include "cli/view/pass_costs.hpp"
#include "live/look_field.hpp"
#include "live/picture_field.hpp"
#include "render/flat_view.hpp"
#include "render/picture_look.hpp"
#include "render/renderer.hpp"
#include "render/shown_floats.hpp"

#include <map>
#include <optional>
#include <vector>

namespace tidemark::cli {

/// The pictures of one Renderer, in its context.
class PictureViews {
public:
    /// The large picture and its view settings, into which the automatic exposure is written.
    struct Large {
        std::optional<size_t> index{}; ///< index into `fields`; beyond the end: none
        live::LookField look{};
        Extent window{};
    };

    /// Returns the outputs of passes, then their inputs. `floats` and `inputs` give the shown pass in floats.
    std::vector<live::PictureField> fields(const render::Renderer& renderer, const PassCosts& costs,
                                           Large& large, render::ShownFloats& floats,
                                           const render::FrameInputs& inputs);

private:
    const gl::Texture* flat(const gl::Texture& picture, int face, std::optional<int> slice);
    const gl::Texture& looked_at(const gl::Texture& picture, live::LookField& look);

    std::map<GLuint, render::FlatView> flat_{}; ///< views of the textures that are not flat
    std::optional<render::PictureLook> look_{};
};

} // namespace tidemark::cli
