// Compiles a text to a Function: glslang compiles it, SPIRV-Tools inlines it (in a plug-in, loaded at the
// first call), and the module is split into scalars.
#pragma once

#include "base/error.hpp"
#include "proof/function.hpp"
#include "proof/plugin/spirv_compiler.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace tidemark::proof {

/// Compiles a whole fragment shader; line numbers in the error and in the function are those of `text`. The
/// error is the compiler's message, or names the construct that is not supported.
Result<Function> compile(const std::string& text, Names names = Names::drop);

/// Reads a module that the plug-in made.
Result<Function> read_spirv(std::span<const uint32_t> words);

} // namespace tidemark::proof
