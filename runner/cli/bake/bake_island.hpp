// `bake island`: the fields of a terrain that waves roll in to, and the study of how exactly they are known.
#pragma once

#include "cli/command_line.hpp"
#include "cli/commands.hpp"

namespace tidemark::cli {

void add_bake_island(Command bake, Action& chosen);

} // namespace tidemark::cli
