// What the program and the plug-in of glslang and SPIRV-Tools say to each other: a fragment shader in, one
// inlined function in SPIR-V out. Both are built together. Nothing is thrown across.
#pragma once

#include <tl/expected.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace tidemark::ir {

/// The words of a module whose entry point calls nothing and has its variables in SSA form as far as their
/// kinds allow. The error is the compiler's log, or why it was not tried.
using SpirvResult = tl::expected<std::vector<uint32_t>, std::string>;

/// Whether a function knows the variables of its text (source_names.hpp): that makes modules some times
/// larger. With `keep` a text has no values of global variables outside of `main` (glslang 12 crashes on
/// them: glsl::assign_globals_in_main).
enum class Names { drop, keep };

struct SpirvCompiler {
    unsigned version;
    /// `text` is a whole fragment shader of OpenGL.
    SpirvResult (*compile)(const std::string& text, Names names) noexcept;
};

inline constexpr unsigned k_spirv_compiler_version = 2;
inline constexpr const char* k_spirv_compiler_entry = "tidemark_spirv_compiler";

} // namespace tidemark::ir
