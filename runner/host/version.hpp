// The version of the program, from CMake's project().
#pragma once

namespace tidemark::cli {

inline constexpr const char* k_version = TIDEMARK_VERSION;

} // namespace tidemark::cli
