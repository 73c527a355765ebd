// Maps the SPIR-V instructions and built-in functions that work component by component to our operations.
#pragma once

#include "ir/function.hpp"

#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.hpp>

#include <optional>

namespace tidemark::ir {

std::optional<Op> componentwise(spv::Op instruction);
std::optional<Op> componentwise(GLSLstd450 function);

} // namespace tidemark::ir
