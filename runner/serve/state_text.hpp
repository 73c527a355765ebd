// What a page shows beside the picture, as JSON: the overlay's model, less what changes with every picture.
#pragma once

#include "base/extent.hpp"
#include "live/model.hpp"

#include <string>

namespace tidemark::serve {

/// `{"state":{…}}`. `keyboard`: keys are the scene's.
std::string state_text(const live::Model& model, Extent extent, bool keyboard);

/// What stands before a picture: its number, its moment, and what each pass took in milliseconds.
std::string picture_head(uint32_t number, double seconds, int frame,
                         const std::vector<live::PictureField>& pictures);

/// A message of one line of text: `{"title":"…"}`.
std::string line_text(const char* name, const std::string& line);

} // namespace tidemark::serve
