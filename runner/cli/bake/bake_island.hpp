// `bake island`: the fields of a terrain that waves roll in to, and the study of how exactly they are known.
#pragma once

#include "cli/commands.hpp"

namespace tidemark::cli {

void add_bake_island(CLI::App& bake, Action& chosen);

} // namespace tidemark::cli
