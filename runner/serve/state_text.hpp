// What a page shows beside the picture, as JSON: the overlay's model, less what changes with every picture.
#pragma once

#include "base/extent.hpp"
#include "live/model.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::serve {

/// `{"state":{…}}`. `keyboard`: keys are the scene's.
std::string state_text(const live::Model& model, Extent extent, bool keyboard);

/// What stands before a picture in its message.
struct PictureHead {
    uint32_t number = 0; ///< from 1
    double seconds = 0;  ///< iTime
    int frame = 0;
    std::vector<std::optional<double>> costs{}; ///< milliseconds of each pass, by the driver's timer
    double draw_ms = 0; ///< from the event that asked for it, where one did, until its pixels were there
    double encode_ms = 0;
    std::string_view coding = "jpeg"; ///< else of a film: "key", or "delta" from the picture before
};
std::string to_text(const PictureHead& head);

/// A message of one line of text: `{"title":"…"}`.
std::string line_text(const char* name, const std::string& line);

} // namespace tidemark::serve
