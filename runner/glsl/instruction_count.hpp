// Reads the number of a shader's instructions from a driver's messages. Their formats follow no standard: a
// message that does not match clearly is ignored.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace tidemark::glsl {

struct InstructionCount {
    std::string shader; ///< the driver's name for it: `FS SIMD8`
    int instructions = 0;

    bool operator==(const InstructionCount&) const = default;
};

/// Reads Mesa's formats: `FS SIMD8 shader: 123 inst, 0 loops, …` (Intel; Adreno, Panfrost and others alike),
/// `… prog 1/2: 123 instructions, …` (VideoCore) and `type: 4, …, inst: 123, …` (nouveau). AMD's messages
/// have the code size but no count.
std::optional<InstructionCount> read_instruction_count(std::string_view message);

} // namespace tidemark::glsl
