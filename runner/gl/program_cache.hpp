// Programs that were linked in an earlier run, in the driver's own form.
#pragma once

#include "gl/program.hpp"

namespace tidemark::gl {

/// As Program::link. What this version of ours had this driver link before is taken from the user's cache
/// folder, and what it links now is put there; where the driver has no such form, or does not take one of its
/// own any more, it compiles.
tl::expected<Program, std::string> link_or_recall(std::string_view vertex, std::string_view fragment);

} // namespace tidemark::gl
