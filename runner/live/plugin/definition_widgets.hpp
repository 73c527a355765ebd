// Fields for the numbers that a scene defines.
#pragma once

#include "live/command.hpp"
#include "live/definition_field.hpp"

#include <vector>

namespace tidemark::live {

void draw_definitions(std::vector<DefinitionField>& fields, Commands& commands);

} // namespace tidemark::live
