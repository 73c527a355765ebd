// From a text to its Function: glslang compiles it, SPIRV-Tools inlines it (a plug-in, loaded when it is
// first asked for), and the module is taken apart into scalars.
#pragma once

#include "base/result.hpp"
#include "ir/function.hpp"
#include "ir/plugin/spirv_compiler.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tidemark::ir {

/// Of a whole fragment shader; lines in the error and in the function are those of `text`. An error says what
/// the compiler refuses, or what of the text cannot be followed.
Result<Function> compile(const std::string& text, Names names = Names::drop);

/// Of a module that the plug-in made.
Result<Function> read_spirv(std::span<const uint32_t> words);

} // namespace tidemark::ir
