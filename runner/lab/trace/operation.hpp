// Explains on the CPU why a GLSL operation gave its result, from operand values that the shader recorded.
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

/// A scalar, vector or matrix of a shader, as bits; matrices column by column.
struct ShaderValue {
    glsl::ValueType type;
    std::array<uint32_t, 16> bits{};

    size_t size() const { return size_t(type.columns * type.rows); }
    /// Returns component i as a number, whatever its type.
    double number(size_t i) const;
    bool finite() const;
};

/// Reads a slot of glsl::WatchLayout; returns nothing if it was not written.
std::optional<ShaderValue> read_slot(std::span<const uint32_t> words, size_t slot);
/// Returns the fewest digits that identify this float, or "NaN", "+Inf" or "-Inf".
std::string to_shortest(float number);
/// Returns, for example, `0.31`, `vec2(0, -1)` or `70000 (0x11170)`.
std::string to_string(const ShaderValue& value);
/// Returns "NaN", or the first "+Inf" or "-Inf", of the components; empty if all are finite.
std::string_view worst_of(const ShaderValue& value);

enum class OriginCause {
    operation, ///< the operands are finite; `reason` says what is wrong, if known
    carried,   ///< an operand was not finite already
    undefined, ///< the operands as recorded give a finite result, so the shader used an undefined value
};

struct Explanation {
    OriginCause cause = OriginCause::operation;
    std::string reason{}; ///< "division by zero"; may be empty
    size_t operand = 0;   ///< index of the operand that was not finite
};

/// Explains the result of an operator or built-in function. Unknown operands are ignored; with one of them
/// the cause is never `undefined`.
Explanation explain(std::string_view name, const std::vector<std::optional<ShaderValue>>& operands,
                    const ShaderValue& result);

} // namespace tidemark::lab
