// How many instructions a driver's compiler says a shader has. Drivers tell it in messages of their own
// making, which are nobody's standard: a line that is not clearly one is none.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tidemark::glsl {

struct InstructionCount {
    std::string shader; ///< as the driver calls it: `FS SIMD8`
    int instructions = 0;

    bool operator==(const InstructionCount&) const = default;
};

/// Reads Mesa's forms: `FS SIMD8 shader: 123 inst, 0 loops, …` (Intel; Adreno, Panfrost and others alike),
/// `… prog 1/2: 123 instructions, …` (VideoCore) and `type: 4, …, inst: 123, …` (nouveau). AMD's have the
/// code's size and no count.
std::optional<InstructionCount> read_instruction_count(std::string_view message);

} // namespace tidemark::glsl
