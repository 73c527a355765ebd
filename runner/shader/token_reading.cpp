#include "shader/token_reading.hpp"

#include "shader/vocabulary.hpp"

#include <algorithm>
#include <optional>
#include <unordered_map>
#include <utility>

namespace tidemark::glsl {
namespace {

using text::Token;
using text::TokenKind;

/// Value of a macro in an #if: a number, or the tokens of its #define.
struct Meaning {
    std::optional<long> number;
    size_t body = 0;
    size_t end = 0;
    bool parameters = false;
    bool doubtful = false; ///< whether it is defined depends on unknown conditions
};
struct Macros : std::unordered_map<std::string_view, Meaning> {
    bool all_known = false; ///< the driver defines no others

    /// Returns whether the driver may define that name: drivers announce different extensions.
    bool may_be_the_drivers(std::string_view name) const { return !all_known && name.starts_with("GL_"); }
};
using Value = std::optional<long>; ///< nothing: unknown

Activity both(Activity a, Activity b) {
    return std::min(a, b);
}

Activity truth(Value value) {
    return !value ? Activity::unknown : *value != 0 ? Activity::active : Activity::inactive;
}

Activity negated(Activity a) {
    return a == Activity::active ? Activity::inactive : a == Activity::inactive ? Activity::active : a;
}

Activity is_defined(const Macros& macros, std::string_view name) {
    const auto found = macros.find(name);
    if (found != macros.end())
        return found->second.doubtful ? Activity::unknown : Activity::active;
    return macros.may_be_the_drivers(name) ? Activity::unknown : Activity::inactive;
}

/// Evaluates the expression of an #if. Returns no value for deeply nested or endless macros.
class Condition {
public:
    Condition(const std::vector<Token>& tokens, const Macros& macros) : tokens_(tokens), macros_(macros) {}

    Value evaluate(size_t begin, size_t end) {
        const size_t outer_at = std::exchange(at_, begin);
        const size_t outer_end = std::exchange(end_, end);
        Value value;
        if (++depth_ < k_deepest)
            value = binary(0);
        if (at_ != end_)
            value.reset();
        --depth_;
        at_ = outer_at;
        end_ = outer_end;
        return value;
    }

private:
    static constexpr int k_deepest = 60;
    static constexpr int k_most_steps = 2000;

    struct Operator {
        std::string_view text;
        int rank;
    };

    bool at(std::string_view wanted) const { return at_ < end_ && tokens_[at_].is(wanted); }

    /// Returns the binary operator here. Tries longer operators first, because tokens are single characters.
    std::optional<Operator> next_operator() const {
        constexpr Operator k_binary_operators[] = {{"||", 1}, {"&&", 2}, {"==", 6}, {"!=", 6}, {"<=", 7},
                                                   {">=", 7}, {"<<", 8}, {">>", 8}, {"|", 3},  {"^", 4},
                                                   {"&", 5},  {"<", 7},  {">", 7},  {"+", 9},  {"-", 9},
                                                   {"*", 10}, {"/", 10}, {"%", 10}};
        for (const Operator& op : k_binary_operators) {
            if (at_ >= end_ || tokens_[at_].text[0] != op.text[0])
                continue;
            if (op.text.size() == 1)
                return op;
            if (at_ + 1 < end_ && tokens_[at_ + 1].glued && tokens_[at_ + 1].is(op.text.substr(1)))
                return op;
        }
        return std::nullopt;
    }

    Value binary(int rank) {
        Value left = unary();
        for (auto op = next_operator(); op && op->rank > rank; op = next_operator()) {
            at_ += op->text.size();
            left = apply(op->text, left, binary(op->rank));
        }
        return left;
    }

    static Value apply(std::string_view op, Value a, Value b) {
        if (op == "&&" && ((a && *a == 0) || (b && *b == 0)))
            return 0;
        if (op == "||" && ((a && *a != 0) || (b && *b != 0)))
            return 1;
        if (!a || !b)
            return std::nullopt;
        // Wraps around, like the driver's arithmetic.
        const auto ua = (unsigned long)(*a);
        const auto ub = (unsigned long)(*b);
        switch (op[0]) {
        case '|': return op.size() == 2 ? (*a || *b) : (*a | *b);
        case '&': return op.size() == 2 ? (*a && *b) : (*a & *b);
        case '^': return *a ^ *b;
        case '=': return *a == *b;
        case '!': return *a != *b;
        case '<': return op == "<<" ? long(ua << (ub & 63)) : op == "<=" ? *a <= *b : *a < *b;
        case '>': return op == ">>" ? *a >> (ub & 63) : op == ">=" ? *a >= *b : *a > *b;
        case '+': return long(ua + ub);
        case '-': return long(ua - ub);
        case '*': return long(ua * ub);
        default: break;
        }
        if (*b == 0 || *b == -1)
            return std::nullopt;
        return op == "/" ? *a / *b : *a % *b;
    }

    Value unary() {
        if (at_ >= end_ || ++steps_ > k_most_steps || depth_ >= k_deepest) {
            at_ = end_;
            return std::nullopt;
        }
        const Token& token = tokens_[at_];
        if (token.is("!") || token.is("-") || token.is("+") || token.is("~")) {
            ++at_;
            ++depth_;
            const Value value = unary();
            --depth_;
            return !value          ? value
                   : token.is("!") ? Value(*value == 0)
                   : token.is("-") ? Value(long(0UL - (unsigned long)(*value)))
                   : token.is("~") ? Value(~*value)
                                   : value;
        }
        if (token.is("("))
            return parenthesis();
        ++at_;
        if (token.kind == TokenKind::number)
            return number(token.text);
        if (token.is("defined"))
            return defined();
        if (token.kind == TokenKind::identifier)
            return name(token.text);
        return std::nullopt;
    }

    Value parenthesis() {
        ++at_;
        ++depth_;
        const Value value = binary(0);
        --depth_;
        if (!at(")")) {
            at_ = end_ + 1; // makes the whole expression invalid
            return std::nullopt;
        }
        ++at_;
        return value;
    }

    static Value number(std::string_view digits) {
        while (digits.ends_with('u') || digits.ends_with('U'))
            digits.remove_suffix(1);
        return whole_number(digits);
    }

    Value defined() {
        const bool wrapped = at("(");
        at_ += wrapped ? 1 : 0;
        if (at_ >= end_)
            return std::nullopt;
        const Activity known = is_defined(macros_, tokens_[at_++].text);
        if (wrapped && at(")"))
            ++at_;
        return known == Activity::unknown ? Value{} : Value(known == Activity::active);
    }

    Value name(std::string_view word) {
        const auto found = macros_.find(word);
        if (found == macros_.end())
            return macros_.may_be_the_drivers(word) ? Value{} : Value(0);
        const Meaning& meaning = found->second;
        if (meaning.doubtful || meaning.parameters)
            return std::nullopt;
        return meaning.number ? meaning.number : evaluate(meaning.body, meaning.end);
    }

    const std::vector<Token>& tokens_;
    const Macros& macros_;
    size_t at_ = 0;
    size_t end_ = 0;
    int depth_ = 0;
    int steps_ = 0;
};

class Preprocessor {
public:
    Preprocessor(const std::vector<Token>& tokens, std::span<const KnownMacro> known, bool all_known)
        : tokens_(tokens) {
        macros_.all_known = all_known;
        for (const KnownMacro& macro : known)
            macros_[macro.name] = {.number = macro.value};
        result_.activity.resize(tokens.size(), Activity::active);
        result_.code.reserve(tokens.size());
    }

    Preprocessed run() {
        for (size_t i = 0; i < tokens_.size();) {
            if (tokens_[i].first_on_line && tokens_[i].is("#")) {
                const size_t end = text::end_of_directive(tokens_, i);
                directive(i, end);
                i = end;
                continue;
            }
            result_.activity[i] = here_;
            if (here_ != Activity::inactive)
                result_.code.push_back(i);
            ++i;
        }
        return std::move(result_);
    }

private:
    /// An open #if … #endif.
    struct Group {
        Activity outside; ///< activity outside the group
        Activity left;    ///< whether a later branch may still be taken
    };

    void mark(size_t begin, size_t end) {
        std::fill(result_.activity.begin() + long(begin), result_.activity.begin() + long(end), here_);
    }

    void directive(size_t hash, size_t end) {
        const std::string_view keyword = hash + 1 < end ? tokens_[hash + 1].text : std::string_view{};
        if (keyword == "if" || keyword == "ifdef" || keyword == "ifndef") {
            mark(hash, end);
            groups_.push_back({here_, Activity::active});
            branch(here_ == Activity::inactive ? Activity::inactive : condition(keyword, hash + 2, end));
        } else if (!groups_.empty() && (keyword == "elif" || keyword == "else")) {
            const bool worth_asking = both(groups_.back().outside, groups_.back().left) != Activity::inactive;
            here_ = groups_.back().outside;
            mark(hash, end);
            branch(keyword == "else" || !worth_asking ? Activity::active : condition("if", hash + 2, end));
        } else if (!groups_.empty() && keyword == "endif") {
            here_ = groups_.back().outside;
            groups_.pop_back();
            mark(hash, end);
        } else {
            mark(hash, end);
            if (here_ != Activity::inactive)
                statement(keyword, hash, end);
            else if (keyword.starts_with("else")) // `#elseif`
                result_.directives.push_back(hash);
        }
    }

    void branch(Activity wanted) {
        Group& group = groups_.back();
        here_ = both(group.outside, both(group.left, wanted));
        group.left = both(group.left, negated(wanted));
    }

    Activity condition(std::string_view keyword, size_t begin, size_t end) const {
        if (keyword == "if")
            return truth(Condition(tokens_, macros_).evaluate(begin, end));
        const Activity known = begin < end ? is_defined(macros_, tokens_[begin].text) : Activity::unknown;
        return keyword == "ifdef" ? known : negated(known);
    }

    void statement(std::string_view keyword, size_t hash, size_t end) {
        const bool defines = keyword == "define";
        if ((!defines && keyword != "undef") || hash + 2 >= end) {
            result_.directives.push_back(hash);
            return;
        }
        const Token& name = tokens_[hash + 2];
        size_t body = hash + 3;
        const bool parameters = defines && body < end && tokens_[body].is("(") && tokens_[body].glued;
        while (parameters && body < end && !tokens_[body].is(")"))
            ++body;
        body = std::min(body + (parameters ? 1 : 0), end);
        result_.macros.push_back({name.text, hash, body, end, parameters, !defines, here_});
        if (here_ == Activity::unknown)
            macros_[name.text].doubtful = true;
        else if (defines)
            macros_[name.text] = {std::nullopt, body, end, parameters, false};
        else
            macros_.erase(name.text);
    }

    const std::vector<Token>& tokens_;
    Macros macros_;
    std::vector<Group> groups_;
    Activity here_ = Activity::active;
    Preprocessed result_;
};

} // namespace

Preprocessed preprocess(const std::vector<Token>& tokens, std::span<const KnownMacro> known, bool all_known) {
    return Preprocessor(tokens, known, all_known).run();
}

namespace {

using text::Token;
using text::TokenKind;

class FunctionReader {
public:
    FunctionReader(const std::vector<Token>& tokens, const std::vector<size_t>& code)
        : tokens_(tokens), code_(code) {}

    std::vector<Function> run() {
        while (at_ < code_.size()) {
            if (here().is("{")) {
                at_ = past_braces(at_);
            } else if (auto function = read()) {
                at_ = past(*function);
                functions_.push_back(*std::move(function));
            } else {
                ++at_;
            }
        }
        return std::move(functions_);
    }

private:
    const Token& token(size_t i) const {
        static const Token k_none;
        return i < code_.size() ? tokens_[code_[i]] : k_none;
    }
    const Token& here() const { return token(at_); }
    bool is_name(size_t i) const {
        return token(i).kind == TokenKind::identifier && !is_keyword(token(i).text);
    }

    /// Reads `TYPE NAME (…)` followed by `{` or `;`.
    std::optional<Function> read() {
        const bool type = is_name(at_) || here().is("void");
        if (!type || !is_name(at_ + 1) || !token(at_ + 2).is("("))
            return std::nullopt;
        Function function;
        function.return_type = here().text;
        function.name = token(at_ + 1).text;
        function.type_token = code_[at_];
        function.name_token = code_[at_ + 1];
        function.open = code_[at_ + 2];
        size_t i = at_ + 3;
        for (; i < code_.size() && !token(i).is(")"); ++i)
            if (token(i).is("(") || token(i).is("{") || token(i).is(";"))
                return std::nullopt;
        if (i >= code_.size() || !(token(i + 1).is("{") || token(i + 1).is(";")))
            return std::nullopt;
        function.close = code_[i];
        end_ = i + 1;
        for (size_t first = at_ + 3; first < i;)
            first = read_parameter(function, first, i);
        return function;
    }

    /// Reads a parameter from its first token on; returns where the next one begins.
    size_t read_parameter(Function& function, size_t first, size_t close) const {
        Parameter parameter;
        size_t i = first;
        for (; i < close && !token(i).is(","); ++i) {
            const Token& word = token(i);
            if (word.is("out") || word.is("inout")) {
                parameter.written = true;
                parameter.read = word.is("inout");
            } else if (word.is("[")) {
                parameter.array = true;
            } else if (is_name(i) && parameter.type.empty()) {
                parameter.type = word.text;
            } else if (is_name(i) && parameter.name.empty() && !parameter_array_size(i)) {
                parameter.name = word.text;
            }
        }
        if (!parameter.type.empty())
            function.parameters.push_back(parameter);
        return i + 1;
    }

    bool parameter_array_size(size_t i) const { return token(i - 1).is("["); }

    size_t past(Function& function) const {
        if (!token(end_).is("{"))
            return end_;
        const size_t behind = past_braces(end_);
        function.body_begin = code_[end_];
        function.body_end = code_[behind - 1];
        return behind;
    }

    size_t past_braces(size_t i) const {
        int depth = 0;
        for (; i < code_.size(); ++i) {
            depth += token(i).is("{") ? 1 : token(i).is("}") ? -1 : 0;
            if (depth == 0)
                return i + 1;
        }
        return i;
    }

    const std::vector<Token>& tokens_;
    const std::vector<size_t>& code_;
    std::vector<Function> functions_;
    size_t at_ = 0;
    size_t end_ = 0; ///< end of the last head: its `{` or `;`
};

} // namespace

bool Function::writes_argument() const {
    return std::any_of(parameters.begin(), parameters.end(), [](const auto& each) { return each.written; });
}

std::vector<Function> find_functions(const std::vector<Token>& tokens, const Preprocessed& preprocessed) {
    return FunctionReader(tokens, preprocessed.code).run();
}

const Function* function_around(const std::vector<Function>& functions, size_t token) {
    auto next =
        std::upper_bound(functions.begin(), functions.end(), token,
                         [](size_t wanted, const Function& each) { return wanted < each.type_token; });
    if (next == functions.begin())
        return nullptr;
    --next;
    return next->defined() && token <= next->body_end ? &*next : nullptr;
}

namespace {

/// Maps each opening token to the token that closes it, whatever their kinds are; to the token count if none
/// does.
std::vector<size_t> find_closing(const std::vector<text::Token>& tokens) {
    std::vector<size_t> closing(tokens.size(), tokens.size());
    std::vector<size_t> open;
    for (size_t i = 0; i < tokens.size(); ++i) {
        const text::Token& token = tokens[i];
        if (nesting(token.text) > 0) {
            open.push_back(i);
        } else if (!open.empty() && nesting(token.text) < 0) {
            closing[open.back()] = i;
            open.pop_back();
        }
    }
    return closing;
}

} // namespace

Reading::Reading(std::string_view text)
    : tokens(text::tokenize(text)), preprocessed(preprocess(tokens, {})),
      functions(find_functions(tokens, preprocessed)), places(tokens.size(), Place::code),
      closing_(find_closing(tokens)) {
    for (size_t i = 0; i < tokens.size(); ++i)
        if (tokens[i].first_on_line && tokens[i].is("#"))
            std::fill(places.begin() + long(i), places.begin() + long(text::end_of_directive(tokens, i)),
                      Place::directive);
    for (const Function& function : functions)
        overloads[function.name].push_back(&function);
    for (const MacroLine& macro : preprocessed.macros) {
        std::fill(places.begin() + long(macro.hash), places.begin() + long(macro.body), Place::macro_head);
        std::fill(places.begin() + long(macro.body), places.begin() + long(macro.end), Place::macro_body);
        if (!macro.undefines)
            macros.emplace(macro.name, &macro);
    }
}

bool Reading::defines(std::string_view name) const {
    return macros.contains(name) || overloads.contains(name);
}

size_t Reading::closing(size_t open, size_t end) const {
    return std::min(closing_[open], end);
}

bool Reading::is_pair(size_t i, std::string_view two) const {
    return i + 1 < tokens.size() && tokens[i].is(two.substr(0, 1)) && tokens[i + 1].is(two.substr(1)) &&
           tokens[i + 1].glued;
}

} // namespace tidemark::glsl
