// JSON for the page's panels: the overlay's model without the values that change with every picture.
#pragma once

#include "base/extent.hpp"
#include "live/model.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::serve {

/// Returns `{"state":{…}}`. `keyboard`: the scene reads the keyboard.
std::string state_text(const live::Model& model, Extent extent, bool keyboard);

/// Data sent before a picture in its message.
struct PictureHead {
    uint32_t number = 0; ///< from 1
    double seconds = 0;  ///< iTime
    int frame = 0;
    std::vector<std::optional<double>> costs{}; ///< milliseconds per pass, measured by the driver
    double draw_ms = 0; ///< milliseconds from the event that caused it, if there was one, to its pixels
    double encode_ms = 0;
    std::string_view coding = "jpeg"; ///< or of a film: "key", or "delta" relative to the picture before
};
std::string to_text(const PictureHead& head);

/// Returns a message with one line of text: `{"title":"…"}`.
std::string line_text(const char* name, const std::string& line);

} // namespace tidemark::serve
