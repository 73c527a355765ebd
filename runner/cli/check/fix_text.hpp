// Formats an offered fix as text and as JSON: what was measured before and after.
#pragma once

#include "cli/json_dump.hpp"
#include "lab/fix/mend.hpp"

#include <string>

namespace tidemark::cli {

std::string to_text(const lab::Offer& offer, const glsl::Cure& cure);
Json to_json(const lab::Offer& offer, const glsl::Cure& cure);

} // namespace tidemark::cli
