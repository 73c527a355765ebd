// What a study looks at: a named state, whatever the size of the picture.
#pragma once

#include "base/result.hpp"
#include "render/frame_state.hpp"

#include <glm/vec2.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace tidemark::lab {

struct View {
    std::string name;
    render::FrameState state = render::at_time(0); ///< but for the size, and the mouse, which goes by it
    glm::dvec2 mouse{0};                           ///< where it was clicked, as a part of width and height
};

/// The view in a picture of that size.
render::FrameState state_of(const View& view, Extent extent);

/// `0;10;10@.75,.4`: times in seconds, each with a place of the mouse as a part of the picture, if any. The
/// error (ErrorCode::usage) says what is out of range.
Result<std::vector<View>> parse_views(std::string_view text);

/// Checks time and mouse; the error says which values are possible.
Result<void> check(const View& view);

/// The same view whole frames later, by a name that says so: for a verdict, a moment that no search has seen.
View unseen(const View& view, double seconds_later);

/// A picture of the same shape, its longer side so long at most: for a search.
Extent small_of(Extent extent, int longest);

/// Two moments of a scene that nobody said anything about.
std::vector<View> default_views();

} // namespace tidemark::lab
