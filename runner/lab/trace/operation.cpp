#include "lab/trace/operation.hpp"

#include "glsl/syntax/builtin_functions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>

namespace tidemark::lab {
namespace {

using glsl::Arguments;

bool is_finite_word(uint32_t word) {
    return (word & 0x7f800000u) != 0x7f800000u;
}

/// Returns the CPU version of an operator or of a built-in that works component by component; nullptr if
/// there is none.
auto value_of(std::string_view name) -> double (*)(const Arguments&) {
    if (name == "+")
        return [](const Arguments& a) { return a.x + a.y; };
    if (name == "-")
        return [](const Arguments& a) { return a.x - a.y; };
    if (name == "*")
        return [](const Arguments& a) { return a.x * a.y; };
    if (name == "/")
        return [](const Arguments& a) { return a.x / a.y; };
    const glsl::BuiltinFunction* const function = glsl::find_builtin(name);
    return function ? function->value : nullptr;
}

class Explainer {
public:
    Explainer(std::string_view name, const std::vector<std::optional<ShaderValue>>& operands,
              const ShaderValue& result)
        : name_(name), function_(glsl::find_builtin(name)), operands_(operands), result_(result) {}

    Explanation run() const {
        for (size_t i = 0; i < operands_.size(); ++i)
            if (operands_[i] && !operands_[i]->finite())
                return {OriginCause::carried, {}, i};
        if (name_.starts_with("uintBits") || name_.starts_with("intBits") || name_.starts_with("unpack"))
            return {OriginCause::operation, "the bits are those of no finite number"};
        if (auto reason = of_vectors(); !reason.empty())
            return {OriginCause::operation, std::move(reason)};
        if (!by_number())
            return {};
        for (size_t i = 0; i < result_.size(); ++i)
            if (!is_finite_word(result_.bits[i]))
                if (auto reason = of_numbers(arguments(i)); !reason.empty())
                    return {OriginCause::operation, std::move(reason)};
        return value_of(name_) ? Explanation{OriginCause::undefined, "an undefined value", 0} : Explanation{};
    }

private:
    bool known() const {
        return !operands_.empty() && std::all_of(operands_.begin(), operands_.end(),
                                                 [](const auto& operand) { return operand.has_value(); });
    }

    /// Returns whether component i of the result depends only on component i of the operands.
    bool by_number() const {
        if (!known())
            return false;
        size_t matrices = 0;
        for (const auto& operand : operands_) {
            if (operand->size() != 1 && operand->size() != result_.size())
                return false;
            matrices += operand->type.matrix();
        }
        return name_ != "*" ||
               (matrices < 2 && (matrices == 0 || operands_[0]->size() == 1 || operands_[1]->size() == 1));
    }

    Arguments arguments(size_t component) const {
        const auto at = [&](size_t operand) {
            if (operand >= operands_.size())
                return 0.0;
            const ShaderValue& value = *operands_[operand];
            return value.number(value.size() == 1 ? 0 : component);
        };
        return {at(0), at(1), at(2)};
    }

    std::string of_numbers(const Arguments& arguments) const {
        if (name_ == "/" && arguments.y == 0)
            return arguments.x == 0 ? "0 / 0" : "division by zero";
        if (function_ && function_->domain && operands_.size() == most_parameters(*function_))
            if (const auto* broken = function_->domain->broken(arguments))
                return fmt::format("{} {}", name_, broken->fault);
        const auto value = value_of(name_);
        return value && !(std::abs(value(arguments)) <= double(FLT_MAX))
                   ? "overflow: beyond the largest float"
                   : "";
    }

    static double squares(const ShaderValue& value) {
        double sum = 0;
        for (size_t i = 0; i < value.size(); ++i)
            sum += value.number(i) * value.number(i);
        return sum;
    }

    /// Explains functions of whole vectors.
    std::string of_vectors() const {
        if (!function_ || !function_->is(glsl::Trait::sums_squares) || !known())
            return {};
        double largest = 0;
        for (const auto& operand : operands_)
            largest = std::max(largest, squares(*operand));
        if (function_->domain)
            if (const auto* broken = function_->domain->broken({largest}))
                return fmt::format("{} {}", name_, broken->fault);
        return largest > double(FLT_MAX) / 4 ? "overflow: the squares are beyond the largest float" : "";
    }

    std::string_view name_;
    const glsl::BuiltinFunction* function_; ///< nullptr: an operator
    const std::vector<std::optional<ShaderValue>>& operands_;
    const ShaderValue& result_;
};

} // namespace

double ShaderValue::number(size_t i) const {
    return type.base == 'f'   ? double(std::bit_cast<float>(bits[i]))
           : type.base == 'i' ? double(int32_t(bits[i]))
                              : double(bits[i]);
}

bool ShaderValue::finite() const {
    return type.base != 'f' || std::all_of(bits.begin(), bits.begin() + long(size()), is_finite_word);
}

std::optional<ShaderValue> read_slot(std::span<const uint32_t> words, size_t slot) {
    const auto type = glsl::slot_type(words[slot]);
    if (!type)
        return std::nullopt;
    ShaderValue value{*type, {}};
    std::copy_n(words.begin() + long(slot) + 1, value.bits.size(), value.bits.begin());
    return value;
}

std::string to_shortest(float number) {
    if (std::isnan(number))
        return "NaN";
    if (std::isinf(number))
        return number > 0 ? "+Inf" : "-Inf";
    return fmt::format("{}", number);
}

std::string to_string(const ShaderValue& value) {
    const auto number = [&](size_t i) -> std::string {
        const uint32_t bits = value.bits[i];
        if (value.type.base == 'f')
            return to_shortest(std::bit_cast<float>(bits));
        if (value.type.base == 'b')
            return bits != 0 ? "true" : "false";
        const std::string digits = fmt::format("{:.0f}", value.number(i));
        const bool large = std::abs(value.number(i)) >= 0x10000; // likely a hash or a mask
        return large ? fmt::format("{} ({:#x})", digits, bits) : digits;
    };
    if (value.size() == 1)
        return number(0);
    std::string text = to_string(value.type) + "(";
    for (size_t i = 0; i < value.size(); ++i)
        text += (i > 0 ? ", " : "") + number(i);
    return text + ")";
}

std::string_view worst_of(const ShaderValue& value) {
    std::string_view worst;
    for (size_t i = 0; i < value.size() && !value.finite(); ++i) {
        const double x = value.number(i);
        if (std::isnan(x))
            return "NaN";
        if (std::isinf(x) && worst.empty())
            worst = x > 0 ? "+Inf" : "-Inf";
    }
    return worst;
}

Explanation explain(std::string_view name, const std::vector<std::optional<ShaderValue>>& operands,
                    const ShaderValue& result) {
    return Explainer(name, operands, result).run();
}

} // namespace tidemark::lab
