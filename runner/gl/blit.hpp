// Pictures copied and shown as a whole, by the driver's own blit.
#pragma once

#include "gl/render_target.hpp"

#include <optional>

namespace tidemark::gl {

/// Shows the target in the window's own framebuffer as large as its proportions allow, in its middle; black
/// beside it.
void blit_fitted(const RenderTarget& target, Extent window);

/// The target as a window shows it: in bytes. Nothing when there is no memory for it.
std::optional<RenderTarget> copy_in_bytes(const RenderTarget& target);

/// A target of a texture that another context has drawn, as it is: contexts share textures, and nothing that
/// they are drawn by.
RenderTarget attach(Texture texture);

} // namespace tidemark::gl
