// Why an operation of GLSL gave what it gave: from the operands that a shader wrote down, on the CPU.
#pragma once

#include "glsl/instrument/watch.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::lab {

/// A number, vector or matrix of a shader. Matrices column by column.
struct ShaderValue {
    glsl::ValueType type;
    std::array<uint32_t, 16> bits{};

    size_t size() const { return size_t(type.columns * type.rows); }
    /// Any type as a number.
    double number(size_t i) const;
    bool finite() const;
};

/// A slot of glsl::WatchLayout; nothing where none was written.
std::optional<ShaderValue> read_slot(std::span<const uint32_t> words, size_t slot);
/// The fewest digits that are this float and no other; "NaN", "+Inf", "-Inf".
std::string to_shortest(float number);
/// `0.31`, `vec2(0, -1)`, `70000 (0x11170)`.
std::string to_string(const ShaderValue& value);
/// "NaN", "+Inf" or "-Inf"; the worst of its numbers. Empty for a finite one.
std::string_view worst_of(const ShaderValue& value);

enum class OriginCause {
    operation, ///< finite operands; the reason says what is wrong with them, where we know
    carried,   ///< an operand was no finite number already
    undefined, ///< these operands give a finite result: what the shader computed with had no value
};

struct Explanation {
    OriginCause cause = OriginCause::operation;
    std::string reason{}; ///< "division by zero"; may be empty
    size_t operand = 0;   ///< the one that was not finite
};

/// `name` is an operator or a built-in function. Operands that are not known are left out of account: then
/// nothing is called undefined.
Explanation explain(std::string_view name, const std::vector<std::optional<ShaderValue>>& operands,
                    const ShaderValue& result);

} // namespace tidemark::lab
