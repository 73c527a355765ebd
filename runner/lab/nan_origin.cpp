#include "base/encoding.hpp"
#include "lab/nan_trace.hpp"
#include "shader/builtin_functions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cfloat>
#include <charconv>
#include <cmath>

namespace tidemark::lab {
namespace {

using glsl::Arguments;

bool is_finite_word(uint32_t word) {
    return (word & 0x7f800000u) != 0x7f800000u;
}

/// Returns the CPU version of an operator or of a built-in that works component by component; nullptr if
/// there is none.
auto evaluation_of(std::string_view name) -> double (*)(const Arguments&) {
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

class OriginExplainer {
public:
    OriginExplainer(std::string_view name, const std::vector<std::optional<ShaderValue>>& operands,
                    const ShaderValue& result)
        : name_(name), function_(glsl::find_builtin(name)), operands_(operands), result_(result) {}

    Explanation run() const {
        for (size_t i = 0; i < operands_.size(); ++i)
            if (operands_[i] && !operands_[i]->finite())
                return {OriginCause::carried, {}, i};
        if (name_.starts_with("uintBits") || name_.starts_with("intBits") || name_.starts_with("unpack"))
            return {OriginCause::operation, "the bits do not encode a finite number"};
        if (auto reason = of_vectors(); !reason.empty())
            return {OriginCause::operation, std::move(reason)};
        if (!by_number())
            return {};
        for (size_t i = 0; i < result_.size(); ++i)
            if (!is_finite_word(result_.bits[i]))
                if (auto reason = of_numbers(arguments(i)); !reason.empty())
                    return {OriginCause::operation, std::move(reason)};
        return evaluation_of(name_) ? Explanation{OriginCause::undefined, "an undefined value", 0}
                                    : Explanation{};
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
        const auto value = evaluation_of(name_);
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
    return OriginExplainer(name, operands, result).run();
}

namespace {

using glsl::k_no_node;
using glsl::NodeId;
using glsl::NodeKind;
using glsl::WatchLayout;

constexpr size_t k_longest_text = 80;

/// Returns the assignment, declarator or return statement that receives the value.
NodeId target_of(const WatchedText& watched, NodeId id) {
    const glsl::SyntaxTree& tree = watched.text.tree();
    for (NodeId around = id; around != k_no_node; around = tree[around].parent) {
        const NodeKind kind = tree[around].kind;
        if (kind == NodeKind::assign || kind == NodeKind::declarator || kind == NodeKind::return_statement)
            return around;
        if (!glsl::is_expression(kind))
            return k_no_node;
    }
    return k_no_node;
}

std::string variable_of(const WatchedText& watched, NodeId target) {
    const glsl::SyntaxTree& tree = watched.text.tree();
    if (target == k_no_node || tree[target].kind == NodeKind::return_statement)
        return {};
    if (tree[target].kind == NodeKind::declarator)
        return std::string(watched.text.word_of(target));
    return watched.text.excerpt(tree.child(target, 0));
}

/// Parses a number literal of the text.
std::optional<ShaderValue> literal(std::string_view digits) {
    if (digits.starts_with("0x") || digits.starts_with("0X")) {
        ShaderValue value{{'u'}, {}};
        const auto read =
            std::from_chars(digits.data() + 2, digits.data() + digits.size(), value.bits[0], 16);
        return read.ec == std::errc{} ? std::optional(value) : std::nullopt;
    }
    float number = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (error != std::errc{})
        return std::nullopt;
    ShaderValue value{{}, {}};
    value.bits[0] = std::bit_cast<uint32_t>(number);
    return value;
}

/// Returns, for example, "iChannel0 (Buffer A)".
std::string channel_label(const scene::Scene& scene, const scene::Pass& pass, std::string_view sampler) {
    if (sampler.size() == 9 && sampler.starts_with("iChannel") && sampler[8] >= '0' && sampler[8] <= '3')
        if (const size_t* source = source_pass(pass.channels[size_t(sampler[8] - '0')].input))
            return fmt::format("{} ({})", sampler, scene.passes[*source].name);
    return std::string(sampler);
}

std::string operation_name(const WatchedText& watched, NodeId id) {
    const glsl::SyntaxTree& tree = watched.text.tree();
    if (tree[id].kind == NodeKind::call)
        return std::string(glsl::called_name(watched.text, id));
    const std::string_view op = watched.text.word_of(id);
    return std::string(tree[id].kind == NodeKind::assign ? op.substr(0, 1) : op);
}

std::string origin_of(const WatchedText& watched, NodeId operation, const Explanation& why,
                      const std::vector<NodeId>& nodes, const scene::Scene& scene, const scene::Pass& pass) {
    const std::string name = operation_name(watched, operation);
    if (name.starts_with("tex") && !watched.facts.function(name) && !nodes.empty() &&
        why.cause != OriginCause::carried)
        return channel_label(scene, pass, base_name(watched, nodes[0]));
    if (why.cause != OriginCause::carried || why.operand >= nodes.size())
        return {};
    const std::string_view base = base_name(watched, nodes[why.operand]);
    const auto meanings = watched.facts.names.find(base);
    if (meanings != watched.facts.names.end() && meanings->second.uniform)
        return fmt::format("the uniform {}", base);
    if (meanings != watched.facts.names.end() && meanings->second.constant)
        return fmt::format("the constant {}", base);
    return {};
}

/// Returns whether the expression consists of literals and types, as `0.5`, `vec3(0.5)` and `-1.0` do: its
/// value adds nothing to its text.
bool is_spelled_out(const WatchedText& watched, NodeId id) {
    const glsl::Node& node = watched.text.tree()[id];
    for (size_t i = node.begin; i < node.end; ++i) {
        const glsl::Word& word = watched.text.words()[i];
        if (word.kind == text::TokenKind::identifier && !watched.facts.is_type(word.text))
            return false;
    }
    return true;
}

void add_way(NanOrigin& origin, const WatchedText& watched, const glsl::Watch& watch,
             const WatchReading& reading) {
    const auto& words = reading.words;
    const glsl::SyntaxTree& tree = watched.text.tree();
    const size_t depth = std::min<size_t>(words[WatchLayout::k_depth], WatchLayout::k_most_calls);
    for (size_t i = 0; i < depth; ++i) {
        const NodeId call = words[WatchLayout::k_path + i];
        if (call < tree.nodes.size())
            origin.calls.push_back(
                {watched.text.used(tree[call].begin), std::string(glsl::called_name(watched.text, call))});
    }
    for (size_t i = 0; i < watch.loops.size(); ++i)
        origin.loops.push_back(
            {watched.text.used(tree[watch.loops[i]].begin), words[WatchLayout::k_loops + i]});
    // Loops that were not entered are not on the path.
    std::erase_if(origin.loops, [](const TracedLoop& loop) { return loop.iteration == 0; });
}

} // namespace

std::string shortened(std::string text) {
    if (text.size() <= k_longest_text)
        return text;
    return text.substr(0, begin_of_character(text, k_longest_text - 4)) + " …";
}

std::string_view base_name(const WatchedText& watched, NodeId id) {
    const glsl::SyntaxTree& tree = watched.text.tree();
    while (tree[id].kind == NodeKind::member || tree[id].kind == NodeKind::index ||
           tree[id].kind == NodeKind::parenthesis)
        id = tree.child(id, 0);
    return tree[id].kind == NodeKind::name ? watched.text.word_of(id) : std::string_view{};
}

std::vector<NodeId> operands(const WatchedText& watched, NodeId operation) {
    std::vector<NodeId> nodes = watched.text.tree().children(operation);
    if (watched.text.tree()[operation].kind == NodeKind::call)
        nodes.erase(nodes.begin());
    return nodes;
}

NanOrigin describe(const WatchedText& watched, NodeId operation) {
    const glsl::SyntaxTree& tree = watched.text.tree();
    const glsl::Node& node = tree[operation];
    NanOrigin origin;
    // If only the operator stands in a macro, its place is the line that is meant, not that of the first
    // operand.
    origin.where = watched.text.spelled(node.begin);
    const glsl::Word& first = watched.text.words()[node.begin];
    const glsl::Word& sign = watched.text.words()[node.word];
    if (sign.from_macro() && !first.from_macro())
        origin.where = watched.text.spelled(node.word);
    if (sign.from_macro())
        origin.used = watched.text.used(node.word);
    origin.operation = shortened(watched.text.excerpt(operation));
    const NodeId target = target_of(watched, operation);
    origin.statement = origin.operation;
    if (target != k_no_node && watched.text.excerpt(target).size() <= k_longest_text)
        origin.statement = watched.text.excerpt(target);
    if (origin.statement.ends_with(';'))
        origin.statement.pop_back();
    origin.variable = variable_of(watched, target);
    const NodeId function = tree.around(operation, NodeKind::function);
    if (function != k_no_node)
        origin.function = watched.text.word_of(function);
    return origin;
}

void add_reading(NanOrigin& origin, const WatchedText& watched, NodeId operation, const glsl::Watch& watch,
                 const WatchReading& reading, const scene::Scene& scene, const scene::Pass& pass) {
    const glsl::SyntaxTree& tree = watched.text.tree();
    origin.value = read_slot(reading.words, WatchLayout::k_value);
    const std::vector<NodeId> nodes = operands(watched, operation);
    std::vector<std::optional<ShaderValue>> values;
    origin.operands.clear();
    for (const NodeId node : nodes) {
        std::optional<ShaderValue> value;
        const auto slot = std::find(watch.operands.begin(), watch.operands.end(), node);
        if (tree[node].kind == NodeKind::literal)
            value = literal(watched.text.word_of(node));
        else if (slot != watch.operands.end())
            value = read_slot(reading.words, WatchLayout::k_operands +
                                                 size_t(slot - watch.operands.begin()) * WatchLayout::k_slot);
        values.push_back(value);
        const NodeId shown = without_brackets(tree, node);
        std::string text = shortened(watched.text.excerpt(shown));
        const bool listed = std::any_of(origin.operands.begin(), origin.operands.end(),
                                        [&](const TracedOperand& operand) { return operand.text == text; });
        if (!listed && !is_spelled_out(watched, shown))
            origin.operands.push_back({std::move(text), value});
    }
    if (origin.value)
        origin.why = explain(operation_name(watched, operation), values, *origin.value);
    origin.source = origin_of(watched, operation, origin.why, nodes, scene, pass);
    add_way(origin, watched, watch, reading);
}

} // namespace tidemark::lab
