// `bake island`: bakes the fields of a terrain for waves that roll in to the shore, and studies their
// accuracy.
#pragma once

#include "cli/command_line.hpp"
#include "cli/commands.hpp"

namespace tidemark::cli {

void add_bake_island(Command bake, Action& chosen);

} // namespace tidemark::cli
