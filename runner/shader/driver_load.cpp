#include "shader/driver_log.hpp"
#include "shader/parsed_text.hpp"
#include "shader/pass_reading.hpp"
#include "shader/tree_facts.hpp"
#include "shader/vocabulary.hpp"

#include <algorithm>
#include <limits>
#include <string_view>
#include <unordered_map>

namespace tidemark::glsl {
namespace {

constexpr double k_unknown = std::numeric_limits<double>::infinity();

/// Measured: 2^16 calls of one function take 20 s and more, an array of 4,000 in a function takes half a GiB,
/// and a sum of 16,000 terms overflows the stack.
constexpr size_t k_many_words = 60'000;
constexpr int k_deep = 500;
constexpr double k_long_inlined = 200'000;
constexpr double k_many_elements = 1000;
constexpr int k_many_loops = 7;
/// The numbers of a mat4.
constexpr double k_largest_plain = 16;
/// 2^31: as an unsigned literal it becomes the least int when it is converted.
constexpr long k_sign_bit = 1L << 31;
/// Nesting of parentheses in an array length.
constexpr int k_deepest_length = 20;

/// Returns the number of scalars in a built-in type.
double components_of(std::string_view type) {
    const auto digit = [&](size_t at) { return double(type[at] - '0'); };
    const size_t size = type.size();
    if (size >= 4 && type.substr(size >= 6 ? size - 6 : 0, 3) == "mat" && type[size - 2] == 'x')
        return digit(size - 3) * digit(size - 1);
    if (size < 4 || type.back() < '2' || type.back() > '4')
        return 1;
    if (type.substr(size - 4, 3) == "vec")
        return digit(size - 1);
    return type.substr(size - 4, 3) == "mat" ? digit(size - 1) * digit(size - 1) : 1;
}

class Weigher {
public:
    explicit Weigher(const ParsedText& text) : text_(text), tree_(text.tree()) {}

    DriverLoad run() {
        DriverLoad load;
        load.followed = true;
        load.words = text_.words().size();
        load.depth = tree_[0].height;
        load.edge_of_int = has_largest_int() && has_minus_one();
        count_loops();
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) { // children before their parents
            const Node& node = tree_[id];
            if (node.kind == NodeKind::structure)
                structures_[text_.word_of(id)] = members(id);
            else if (node.kind == NodeKind::declaration)
                declare(id);
            else if (node.kind == NodeKind::parameter)
                count(declared(id, tree_[tree_.child(id, 0)].end, components(tree_.child(id, 0))));
            else if (node.kind == NodeKind::call)
                calls_.push_back(id);
            else if (node.kind == NodeKind::function)
                define(id);
        }
        load.elements = elements_;
        for (const auto& [name, function] : functions_) {
            load.inlined = std::max(load.inlined, function.words);
            load.loops = std::max(load.loops, function.loops);
        }
        return load;
    }

private:
    /// Checks the whole text, since directives are constant-folded too. Finds INT_MAX, larger and hexadecimal
    /// numbers.
    bool has_largest_int() const {
        const auto& tokens = text_.tokens();
        for (size_t i = 2; i < tokens.size(); ++i) {
            const std::string_view word = tokens[i].text;
            if (tokens[i].kind != text::TokenKind::number)
                continue;
            const size_t digits = word.find_last_not_of("uU") + 1;
            const auto number = whole_number(word.substr(0, digits));
            const bool shifted = number == 31 && tokens[i - 1].is("<") && tokens[i - 2].is("<");
            const bool too_long = !number && word.find_first_of(".eEpP") == word.npos;
            const bool is_unsigned = digits < word.size();
            const bool large =
                number && (is_unsigned ? *number == k_sign_bit : *number >= std::numeric_limits<int>::max());
            if (shifted || too_long || large)
                return true;
        }
        return false;
    }

    bool has_minus_one() const {
        const auto& tokens = text_.tokens();
        for (size_t i = 1; i < tokens.size(); ++i)
            if ((tokens[i - 1].is("-") && (tokens[i].is("1") || tokens[i].is("0x1"))) ||
                (tokens[i - 1].is("~") && (tokens[i].is("0") || tokens[i].is("0x0"))))
                return true;
        return false;
    }

    /// Goes backwards, since parents come after their children.
    void count_loops() {
        loops_.resize(tree_.nodes.size());
        for (size_t id = tree_.nodes.size() - 1; id > 0; --id)
            loops_[id] = loops_[tree_[NodeId(id)].parent] + (is_loop(tree_[NodeId(id)].kind) ? 1 : 0);
    }

    /// Returns the product of all bracketed lengths among the words.
    double lengths(size_t begin, size_t end) const {
        double product = 1;
        for (size_t i = begin; i < end; ++i) {
            if (text_.word(i) != "[")
                continue;
            size_t at = i + 1;
            const double length = sum(at, end, 0);
            if (at >= end || text_.word(at) != "]")
                return text_.word(i + 1) == "]" ? product : k_unknown;
            product *= length;
        }
        return product;
    }

    /// Evaluates `3`, `N` or `4 * (N + 1)` and moves `at` past it. Other constant expressions of GLSL are
    /// unknown.
    double sum(size_t& at, size_t end, int depth) const {
        double total = product(at, end, depth);
        while (at < end && (text_.word(at) == "+" || text_.word(at) == "-")) {
            const bool plus = text_.word(at++) == "+";
            const double next = product(at, end, depth);
            total = plus ? total + next : total; // an upper bound: differences are not subtracted
        }
        return total;
    }

    double product(size_t& at, size_t end, int depth) const {
        double total = factor(at, end, depth);
        while (at < end && text_.word(at) == "*")
            total *= factor(++at, end, depth);
        return total;
    }

    double factor(size_t& at, size_t end, int depth) const {
        if (at >= end || depth > k_deepest_length)
            return k_unknown;
        const std::string_view word = text_.word(at++);
        if (word == "(") {
            const double inside = sum(at, end, depth + 1);
            if (at >= end || text_.word(at) != ")")
                return k_unknown;
            ++at;
            return inside;
        }
        const bool has_suffix = !word.empty() && (word.back() == 'u' || word.back() == 'U');
        if (const auto number = whole_number(word.substr(0, word.size() - (has_suffix ? 1 : 0))))
            return double(*number);
        const auto known = constants_.find(word);
        return known == constants_.end() ? k_unknown : known->second;
    }

    double components(NodeId type) const {
        const std::string_view name = type_name(text_, type);
        const auto structure = structures_.find(name);
        const double each = structure != structures_.end() ? structure->second : components_of(name);
        const Node& node = tree_[type];
        // for `struct { … }`, the brackets of members do not belong to the type
        const NodeId own = tree_.child(type, 0);
        return each * lengths(own == k_no_node ? node.begin : tree_[own].end, node.end);
    }

    /// Multiplies by the lengths between a declarator's name and its value.
    double declared(NodeId declarator, size_t begin, double each) const {
        size_t end = tree_[declarator].end;
        for (const NodeId part : tree_.children(declarator))
            if (!is_bracket(text_, part) && tree_[part].kind != NodeKind::type)
                end = std::min<size_t>(end, tree_[part].begin);
        return each * lengths(begin, end);
    }

    /// Calls `take` with the size of each declared variable.
    template <class Take>
    void each_of(NodeId declaration, const Take& take) const {
        const std::vector<NodeId> parts = tree_.children(declaration);
        const double each = parts.empty() ? 0 : components(parts.front());
        for (size_t i = 1; i < parts.size(); ++i)
            take(declared(parts[i], tree_[parts[i]].begin, each));
    }

    double members(NodeId structure) const {
        double total = 0;
        for (const NodeId member : tree_.children(structure))
            each_of(member, [&](double elements) { total += elements; });
        return total;
    }

    /// Counts arrays and structures only; smaller variables fit in registers.
    void count(double elements) {
        if (elements > k_largest_plain)
            elements_ += elements;
    }

    void declare(NodeId declaration) {
        const std::vector<NodeId> parts = tree_.children(declaration);
        if (parts.empty())
            return;
        if (parts.size() == 1 && has_qualifier(text_, parts.front(), "uniform")) // `uniform Block { … };`
            if (const NodeId block = tree_.child(parts.front(), 0); block != k_no_node)
                count(members(block));
        if (tree_[tree_[declaration].parent].kind != NodeKind::structure)
            each_of(declaration, [this](double elements) { count(elements); });
        if (has_qualifier(text_, parts.front(), "const") &&
            class_of_type(type_name(text_, parts.front())) == TypeClass::whole)
            for (size_t i = 1; i < parts.size(); ++i)
                remember(parts[i]);
    }

    /// The larger of two constants with the same name counts.
    void remember(NodeId constant) {
        const std::vector<NodeId> parts = tree_.children(constant);
        if (parts.empty() || is_bracket(text_, parts.back()))
            return;
        const Node& value = tree_[parts.back()];
        size_t at = value.begin;
        const double number = sum(at, value.end, 0);
        double& known = constants_[text_.word_of(constant)];
        known = std::max(known, at == value.end ? number : k_unknown);
    }

    /// All calls since the last function are in this one.
    void define(NodeId function) {
        if (const NodeId type = tree_.child(function, 0); tree_[type].kind == NodeKind::type)
            count(components(type));
        Size size{double(tree_[function].end - tree_[function].begin), 0};
        for (NodeId id = first_node_; id < function; ++id)
            size.loops = std::max(size.loops, loops_[id]);
        first_node_ = function + 1;
        for (const NodeId call : calls_) {
            const auto known = functions_.find(called_name(text_, call));
            if (known == functions_.end())
                continue;
            size.words += known->second.words;
            size.loops = std::max(size.loops, loops_[call] + known->second.loops);
        }
        calls_.clear();
        Size& all = functions_[text_.word_of(function)]; // overloads are added up
        const bool only_declared = all.words == 0 && text_.word(tree_[function].end - 1) == ";";
        // a declared function may be as long as the whole text
        all.words += only_declared ? double(text_.words().size()) : size.words;
        all.loops = std::max(all.loops, size.loops);
    }

    struct Size {
        double words = 0;
        int loops = 0;
    };

    const ParsedText& text_;
    const SyntaxTree& tree_;
    std::unordered_map<std::string_view, double> structures_;
    std::unordered_map<std::string_view, double> constants_;
    std::unordered_map<std::string_view, Size> functions_;
    std::vector<int> loops_; ///< nesting depth of each node, counting itself
    NodeId first_node_ = 1;  ///< first node after the last function
    std::vector<NodeId> calls_;
    double elements_ = 0;
};

} // namespace

bool DriverLoad::modest() const {
    return followed && words <= k_many_words && depth <= k_deep && inlined <= k_long_inlined &&
           loops < k_many_loops && !edge_of_int && elements <= k_many_elements;
}

DriverLoad driver_load(const text::MappedText& source) {
    const auto text = ParsedText::read(source, {}, false);
    return text ? Weigher(**text).run() : DriverLoad{};
}

bool is_modest(const scene::Scene& scene, Precision precision) {
    return std::ranges::all_of(scene.passes, [&](const scene::Pass& pass) {
        const PassReading reading(scene, pass);
        const auto assembly = reading.assemble(reading.dialects(precision).front());
        return !assembly || driver_load(assembly->source).modest(); // a failure here is reported elsewhere
    });
}

} // namespace tidemark::glsl
