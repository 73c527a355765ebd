// Caches linked programs on disk in the driver's binary form.
#pragma once

#include "gl/program.hpp"

namespace tidemark::gl {

/// Links like Program::link, but takes the binary from the user's cache folder when this version of Tidemark
/// linked the same texts with this driver before, and stores a newly linked one. Compiles when the driver
/// supports no binaries or rejects the stored one.
tl::expected<Program, std::string> link_or_recall(std::string_view vertex, std::string_view fragment);

} // namespace tidemark::gl
