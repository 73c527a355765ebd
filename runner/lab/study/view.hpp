// A view of a study: a named state, independent of the picture's size.
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
    /// without the size, and without the mouse, which depends on it
    render::FrameState state = render::at_time(0);
    glm::dvec2 mouse{0}; ///< where it was clicked, as a share of width and height
};

/// Returns the state of the view in a picture of that size.
render::FrameState state_of(const View& view, Extent extent);

/// Parses `0;10;10@.75,.4`: times in seconds, each with an optional place of the mouse as a share of the
/// picture. The error (ErrorCode::usage) names the value that is out of range.
Result<std::vector<View>> parse_views(std::string_view text);

/// Checks time and mouse; the error names the allowed values.
Result<void> check(const View& view);

/// Returns the same view whole frames later, under a name that includes the time: a moment that the search
/// did not use.
View unseen(const View& view, double seconds_later);

/// Returns an extent of the same shape whose longer side is at most `longest`, for a search.
Extent small_of(Extent extent, int longest);

/// Returns two moments, for scenes without views of their own.
std::vector<View> default_views();

} // namespace tidemark::lab
