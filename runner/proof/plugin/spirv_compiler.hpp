// Interface between the program and the plug-in of glslang and SPIRV-Tools: a fragment shader in, one inlined
// function in SPIR-V out. Both are built together. No exceptions cross it.
#pragma once

#include <tl/expected.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace tidemark::proof {

/// The words of a module whose entry point has no calls and has its variables in SSA form as far as their
/// types allow. The error is the compiler's log, or the reason why the text was not compiled.
using SpirvResult = tl::expected<std::vector<uint32_t>, std::string>;

/// Whether a function keeps the names of the text (function.hpp); that makes modules several times
/// larger. With `keep`, a text must not initialise global variables outside of `main` (glslang 12 crashes:
/// glsl::assign_globals_in_main).
enum class Names { drop, keep };

struct SpirvCompiler {
    unsigned version;
    /// `text` is a whole fragment shader for OpenGL.
    SpirvResult (*compile)(const std::string& text, Names names) noexcept;
};

inline constexpr unsigned k_spirv_compiler_version = 2;
inline constexpr const char* k_spirv_compiler_entry = "tidemark_spirv_compiler";

} // namespace tidemark::proof
