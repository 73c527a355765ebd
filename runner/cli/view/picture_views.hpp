// What passes draw and read, as flat pictures that the overlay shows: cubes unfolded, a slice of a volume,
// the large one as it is looked at. Draws nothing of the scene, and nothing while the controls are hidden.
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

/// Of one Renderer, in its context.
class PictureViews {
public:
    /// The one that is seen large, and how; the automatic exposure is told there.
    struct Large {
        std::optional<size_t> index{}; ///< of `fields`; beyond them: none
        live::LookField look{};
        Extent window{};
    };

    /// What passes draw, then what they read. `floats` and `inputs`: the numbers of the shown pass.
    std::vector<live::PictureField> fields(const render::Renderer& renderer, const PassCosts& costs,
                                           Large& large, render::ShownFloats& floats,
                                           const render::FrameInputs& inputs);

private:
    const gl::Texture* flat(const gl::Texture& picture, int face, std::optional<int> slice);
    const gl::Texture& looked_at(const gl::Texture& picture, live::LookField& look);

    std::map<GLuint, render::FlatView> flat_{}; ///< of textures that are not
    std::optional<render::PictureLook> look_{};
};

} // namespace tidemark::cli
