#include "lab/trace/operation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cfloat>
#include <cmath>

namespace tidemark::lab {
namespace {

using glsl::SlotType;

bool is_finite_word(uint32_t word) {
    return (word & 0x7f800000u) != 0x7f800000u;
}

/// The operands at one component; a single number goes with every component.
struct Arguments {
    double a = 0;
    double b = 0;
    double c = 0;
};

/// What is wrong with the arguments of a function that works number by number.
struct Rule {
    std::string_view name;
    std::string_view reason;
    bool (*broken)(const Arguments&);
};

constexpr Rule k_rules[] = {
    {"/", "0 / 0", [](const Arguments& x) { return x.b == 0 && x.a == 0; }},
    {"/", "division by zero", [](const Arguments& x) { return x.b == 0; }},
    {"mod", "mod by zero", [](const Arguments& x) { return x.b == 0; }},
    {"pow", "pow of a negative base is undefined", [](const Arguments& x) { return x.a < 0; }},
    {"pow", "pow of 0 with an exponent that is not positive is undefined",
     [](const Arguments& x) { return x.a == 0 && x.b <= 0; }},
    {"sqrt", "square root of a negative number", [](const Arguments& x) { return x.a < 0; }},
    {"inversesqrt", "inverse square root of a negative number", [](const Arguments& x) { return x.a < 0; }},
    {"inversesqrt", "inverse square root of zero", [](const Arguments& x) { return x.a == 0; }},
    {"log", "logarithm of a negative number", [](const Arguments& x) { return x.a < 0; }},
    {"log", "logarithm of zero", [](const Arguments& x) { return x.a == 0; }},
    {"log2", "logarithm of a negative number", [](const Arguments& x) { return x.a < 0; }},
    {"log2", "logarithm of zero", [](const Arguments& x) { return x.a == 0; }},
    {"asin", "asin outside of [-1, 1]", [](const Arguments& x) { return std::abs(x.a) > 1; }},
    {"acos", "acos outside of [-1, 1]", [](const Arguments& x) { return std::abs(x.a) > 1; }},
    {"acosh", "acosh below 1", [](const Arguments& x) { return x.a < 1; }},
    {"atanh", "atanh outside of (-1, 1)", [](const Arguments& x) { return std::abs(x.a) >= 1; }},
    {"atan", "atan(0, 0) is undefined", [](const Arguments& x) { return x.a == 0 && x.b == 0; }},
    {"smoothstep", "smoothstep between equal edges", [](const Arguments& x) { return x.a == x.b; }},
};

/// The function itself, where it works number by number.
struct Function {
    std::string_view name;
    double (*of)(const Arguments&);
};

constexpr Function k_functions[] = {
    {"+", [](const Arguments& x) { return x.a + x.b; }},
    {"-", [](const Arguments& x) { return x.a - x.b; }},
    {"*", [](const Arguments& x) { return x.a * x.b; }},
    {"/", [](const Arguments& x) { return x.a / x.b; }},
    {"pow", [](const Arguments& x) { return std::pow(x.a, x.b); }},
    {"exp", [](const Arguments& x) { return std::exp(x.a); }},
    {"exp2", [](const Arguments& x) { return std::exp2(x.a); }},
    {"log", [](const Arguments& x) { return std::log(x.a); }},
    {"log2", [](const Arguments& x) { return std::log2(x.a); }},
    {"sqrt", [](const Arguments& x) { return std::sqrt(x.a); }},
    {"inversesqrt", [](const Arguments& x) { return 1 / std::sqrt(x.a); }},
    {"sin", [](const Arguments& x) { return std::sin(x.a); }},
    {"cos", [](const Arguments& x) { return std::cos(x.a); }},
    {"tan", [](const Arguments& x) { return std::tan(x.a); }},
    {"sinh", [](const Arguments& x) { return std::sinh(x.a); }},
    {"cosh", [](const Arguments& x) { return std::cosh(x.a); }},
    {"tanh", [](const Arguments& x) { return std::tanh(x.a); }},
    {"asin", [](const Arguments& x) { return std::asin(x.a); }},
    {"acos", [](const Arguments& x) { return std::acos(x.a); }},
    {"abs", [](const Arguments& x) { return std::abs(x.a); }},
    {"fract", [](const Arguments& x) { return x.a - std::floor(x.a); }},
    {"floor", [](const Arguments& x) { return std::floor(x.a); }},
    {"min", [](const Arguments& x) { return std::min(x.a, x.b); }},
    {"max", [](const Arguments& x) { return std::max(x.a, x.b); }},
    {"mod", [](const Arguments& x) { return x.a - x.b * std::floor(x.a / x.b); }},
    {"mix", [](const Arguments& x) { return x.a * (1 - x.c) + x.b * x.c; }},
    {"radians", [](const Arguments& x) { return x.a * 0.017453292519943295; }},
    {"degrees", [](const Arguments& x) { return x.a * 57.29577951308232; }},
};

class Explainer {
public:
    Explainer(std::string_view name, const std::vector<std::optional<ShaderValue>>& operands,
              const ShaderValue& result)
        : name_(name), operands_(operands), result_(result) {}

    Explanation run() const {
        for (size_t i = 0; i < operands_.size(); ++i)
            if (operands_[i] && !operands_[i]->finite())
                return {OriginCause::carried, {}, i};
        if (name_.starts_with("uintBits") || name_.starts_with("intBits") || name_.starts_with("unpack"))
            return {OriginCause::operation, "the bits are those of no finite number"};
        if (const auto reason = of_vectors(); !reason.empty())
            return {OriginCause::operation, std::string(reason)};
        if (!by_number())
            return {};
        for (size_t i = 0; i < result_.size(); ++i)
            if (!is_finite_word(result_.bits[i]))
                if (const auto reason = of_numbers(arguments(i)); !reason.empty())
                    return {OriginCause::operation, std::string(reason)};
        return is_known_function() ? Explanation{OriginCause::undefined, "an undefined value", 0}
                                   : Explanation{};
    }

private:
    bool known() const {
        return !operands_.empty() && std::all_of(operands_.begin(), operands_.end(),
                                                 [](const auto& operand) { return operand.has_value(); });
    }

    /// Whether component i of the result comes from component i of the operands.
    bool by_number() const {
        if (!known())
            return false;
        size_t matrices = 0;
        for (const auto& operand : operands_) {
            if (operand->size() != 1 && operand->size() != result_.size())
                return false;
            matrices += operand->shape.columns > 1;
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

    std::string_view of_numbers(const Arguments& arguments) const {
        for (const Rule& rule : k_rules)
            if (rule.name == name_ && (name_ != "atan" || operands_.size() == 2) && rule.broken(arguments))
                return rule.reason;
        for (const Function& function : k_functions)
            if (function.name == name_ && !(std::abs(function.of(arguments)) <= double(FLT_MAX)))
                return "overflow: beyond the largest float";
        return {};
    }

    bool is_known_function() const {
        return std::any_of(std::begin(k_functions), std::end(k_functions),
                           [&](const Function& function) { return function.name == name_; });
    }

    static double squares(const ShaderValue& value) {
        double sum = 0;
        for (size_t i = 0; i < value.size(); ++i)
            sum += value.number(i) * value.number(i);
        return sum;
    }

    /// Functions of whole vectors.
    std::string_view of_vectors() const {
        constexpr std::string_view k_lengths[] = {"length", "normalize", "distance",
                                                  "dot",    "cross",     "reflect"};
        if (std::find(std::begin(k_lengths), std::end(k_lengths), name_) == std::end(k_lengths) || !known())
            return {};
        double largest = 0;
        for (const auto& operand : operands_)
            largest = std::max(largest, squares(*operand));
        // Squares this small are none: a float of normal size cannot hold them.
        if (name_ == "normalize" && largest < double(FLT_MIN))
            return largest == 0 ? "normalize of a zero vector"
                                : "normalize of a vector whose squares underflow";
        return largest > double(FLT_MAX) / 4 ? "overflow: the squares are beyond the largest float"
                                             : std::string_view{};
    }

    std::string_view name_;
    const std::vector<std::optional<ShaderValue>>& operands_;
    const ShaderValue& result_;
};

} // namespace

double ShaderValue::number(size_t i) const {
    switch (shape.type) {
    case SlotType::integer: return double(int32_t(bits[i]));
    case SlotType::unsigned_integer:
    case SlotType::boolean: return double(bits[i]);
    default: return double(std::bit_cast<float>(bits[i]));
    }
}

bool ShaderValue::finite() const {
    if (shape.type != SlotType::floating && shape.type != SlotType::matrix)
        return true;
    return std::all_of(bits.begin(), bits.begin() + long(size()), is_finite_word);
}

std::optional<ShaderValue> read_slot(std::span<const uint32_t> words, size_t slot) {
    ShaderValue value{glsl::slot_shape(words[slot]), {}};
    if (value.shape.type == SlotType::none)
        return std::nullopt;
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
        switch (value.shape.type) {
        case SlotType::boolean: return bits != 0 ? "true" : "false";
        case SlotType::integer:
        case SlotType::unsigned_integer: {
            const std::string digits = fmt::format("{:.0f}", value.number(i));
            const bool large = std::abs(value.number(i)) >= 0x10000; // of hashes and masks
            return large ? fmt::format("{} ({:#x})", digits, bits) : digits;
        }
        default: return to_shortest(std::bit_cast<float>(bits));
        }
    };
    if (value.size() == 1)
        return number(0);
    std::string text = value.shape.type == SlotType::matrix
                           ? value.shape.columns == value.shape.rows
                                 ? fmt::format("mat{}(", value.shape.rows)
                                 : fmt::format("mat{}x{}(", value.shape.columns, value.shape.rows)
                           : fmt::format("{}vec{}(",
                                         value.shape.type == SlotType::integer            ? "i"
                                         : value.shape.type == SlotType::unsigned_integer ? "u"
                                         : value.shape.type == SlotType::boolean          ? "b"
                                                                                          : "",
                                         value.shape.rows);
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
