#include "shader/parsed_text.hpp"

#include "base/error.hpp"
#include "shader/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <unordered_map>

namespace tidemark::glsl {
namespace {

using text::Token;
using text::TokenKind;

constexpr size_t k_most_words = 4'000'000;
/// Nesting of macro calls within the arguments of macro calls.
constexpr int k_deepest_arguments = 100;
constexpr size_t k_longest_pasted = 1024; // GLSL's own limit for a name

constexpr std::string_view k_operators[] = {
    "<<=", ">>=", "++", "--", "+=", "-=", "*=", "/=", "%=", "&=", "|=",
    "^=",  "&&",  "||", "^^", "==", "!=", "<=", ">=", "<<", ">>", "##"};

/// Returns the number of tokens of the operator at `i`.
size_t operator_length(const std::vector<Token>& tokens, size_t i, size_t end) {
    if (tokens[i].kind != TokenKind::punctuation)
        return 1;
    for (const std::string_view op : k_operators) {
        size_t matched = 0;
        while (matched < op.size() && i + matched < end && tokens[i + matched].text[0] == op[matched] &&
               tokens[i + matched].kind == TokenKind::punctuation &&
               (matched == 0 || tokens[i + matched].glued))
            ++matched;
        if (matched == op.size())
            return matched;
    }
    return 1;
}

struct Macro {
    std::vector<std::string_view> parameters;
    std::vector<Word> body;
    bool takes_arguments = false;
    bool in_use = false; ///< its replacement is being read, so its name is not expanded
};

/// A word during expansion. A settled one is a macro's own name inside its replacement; it is not expanded.
struct Flowing {
    Word word;
    bool settled = false;
};
using Flow = std::vector<Flowing>;

class Expander {
public:
    Expander(const std::vector<Token>& tokens, const Preprocessed& preprocessed, const text::LineMap& lines)
        : tokens_(tokens), preprocessed_(preprocessed), lines_(lines),
          steps_left_(std::min(k_most_words, 64 * tokens.size() + 10'000)) {}

    Result<Expansion> run() {
        for (const size_t hash : preprocessed_.directives)
            if (hash + 1 < tokens_.size() &&
                (tokens_[hash + 1].is("version") || tokens_[hash + 1].is("extension")))
                result_.headers.push_back(hash);
        const auto& code = preprocessed_.code;
        const auto& macros = preprocessed_.macros;
        size_t next_macro = 0;
        for (size_t begin = 0; begin < code.size() && !error_;) {
            while (next_macro < macros.size() && macros[next_macro].hash < code[begin])
                define(macros[next_macro++]);
            const size_t limit = next_macro < macros.size() ? macros[next_macro].hash : tokens_.size();
            size_t end = begin;
            while (end < code.size() && code[end] < limit)
                ++end;
            stretch(begin, end);
            begin = end;
        }
        if (error_)
            return fail(*std::move(error_));
        return std::move(result_);
    }

private:
    /// One level of input; the innermost is last: the code, then replacements of macros.
    struct Source {
        const Flow* read;       ///< nullptr: reads `own`
        Macro* macro = nullptr; ///< the macro whose replacement this is
        Flow own{};
        size_t at = 0;

        const Flow& words() const { return read ? *read : own; }
        bool exhausted() const { return at >= words().size(); }
    };

    void give_up(size_t token, std::string message) {
        if (error_)
            return;
        error_ = error_at(lines_.locate(tokens_[token].line, tokens_[token].column), std::move(message));
    }

    Word word_at(size_t token, size_t length) const {
        const Token& first = tokens_[token];
        const std::string_view text(first.text.data(), length == 1 ? first.text.size() : length);
        return {text, uint32_t(token), uint32_t(token), first.kind};
    }

    void define(const MacroLine& line) {
        if (line.activity == Activity::unknown)
            return give_up(line.hash, "cannot tell whether this line is compiled");
        if (line.undefines) {
            macros_.erase(line.name);
            return;
        }
        Macro macro;
        macro.takes_arguments = line.parameters;
        for (size_t i = line.hash + 4; line.parameters && i + 1 < line.body; ++i)
            if (tokens_[i].kind == TokenKind::identifier)
                macro.parameters.push_back(tokens_[i].text);
        for (size_t i = line.body; i < line.end;) {
            const size_t length = operator_length(tokens_, i, line.end);
            macro.body.push_back(word_at(i, length));
            i += length;
        }
        macros_.insert_or_assign(line.name, std::move(macro));
    }

    /// Expands the code between two #define or #undef lines.
    void stretch(size_t begin, size_t end) {
        const auto& code = preprocessed_.code;
        Flow flow;
        flow.reserve(end - begin);
        for (size_t i = begin; i < end;) {
            if (preprocessed_.activity[code[i]] == Activity::unknown)
                return give_up(code[i], "cannot tell whether this line is compiled");
            const size_t together = code[i] + (end - i); // the tokens of one operator are adjacent
            const size_t length = operator_length(tokens_, code[i], std::min(together, tokens_.size()));
            flow.push_back({word_at(code[i], length)});
            i += length;
        }
        std::vector<Source> sources;
        sources.push_back({&flow});
        expand_all(sources, result_.words, 0);
    }

    /// Drops exhausted inputs; their macros may be expanded again.
    static void settle(std::vector<Source>& sources) {
        while (sources.size() > 1 && sources.back().exhausted()) {
            sources.back().macro->in_use = false;
            sources.pop_back();
        }
    }

    /// Overloads for both output types of expand_all.
    static void put(std::vector<Word>& to, const Flowing& flowing) { to.push_back(flowing.word); }
    static void put(Flow& to, const Flowing& flowing) { to.push_back(flowing); }

    template <class Output>
    void expand_all(std::vector<Source>& sources, Output& output, int depth) {
        for (;;) {
            settle(sources);
            if (sources.back().exhausted() || error_)
                return;
            Flowing flowing = sources.back().words()[sources.back().at++];
            if (steps_left_ == 0)
                return give_up(flowing.word.used, "its macros make a text that is too long to follow");
            --steps_left_;
            if (flowing.settled || flowing.word.kind != TokenKind::identifier ||
                !open_macro(sources, flowing, depth))
                put(output, flowing);
        }
    }

    /// Pushes the replacement of a macro. Returns false if the name is not to be expanded.
    bool open_macro(std::vector<Source>& sources, Flowing& name, int depth) {
        if (name.word.is("__LINE__") || name.word.is("__FILE__")) {
            const int line = name.word.is("__LINE__") ? tokens_[name.word.used].line : 0;
            name.word.text = result_.pasted.emplace_back(fmt::format("{}", line));
            name.word.kind = TokenKind::number;
            return false;
        }
        const auto found = macros_.find(name.word.text);
        if (found == macros_.end())
            return false;
        Macro& macro = found->second;
        if (macro.in_use) {
            name.settled = true;
            return false;
        }
        std::vector<Flow> arguments;
        if (macro.takes_arguments) {
            settle(sources);
            if (sources.back().exhausted() || !sources.back().words()[sources.back().at].word.is("("))
                return false;
            arguments = read_arguments(sources, name.word);
        }
        if (error_)
            return true;
        sources.push_back({nullptr, &macro, substitute(macro, arguments, name.word, depth)});
        macro.in_use = true;
        return true;
    }

    /// Reads the arguments of a call, from its opening parenthesis on.
    std::vector<Flow> read_arguments(std::vector<Source>& sources, const Word& name) {
        std::vector<Flow> arguments(1);
        int depth = 0;
        for (;;) {
            settle(sources);
            if (sources.back().exhausted() || steps_left_ == 0) {
                give_up(name.used, fmt::format("the macro '{}' is called without an end", name.text));
                return arguments;
            }
            --steps_left_;
            const Flowing& flowing = sources.back().words()[sources.back().at++];
            const Word& word = flowing.word;
            depth += word.is("(") ? 1 : word.is(")") ? -1 : 0;
            if (depth == 0)
                return arguments;
            if (depth == 1 && word.is(","))
                arguments.emplace_back();
            else if (depth > 1 || !word.is("("))
                arguments.back().push_back(flowing);
        }
    }

    Flow substitute(const Macro& macro, const std::vector<Flow>& arguments, const Word& name, int depth) {
        Flow result;
        std::vector<std::optional<Flow>> expanded(arguments.size());
        for (size_t i = 0; i < macro.body.size() && !error_; ++i) {
            const Word& word = macro.body[i];
            const bool pasted = (i + 1 < macro.body.size() && macro.body[i + 1].is("##")) ||
                                (i > 0 && macro.body[i - 1].is("##"));
            if (word.is("##") && !result.empty() && i + 1 < macro.body.size()) {
                paste(result, macro, arguments, macro.body[++i], name);
                continue;
            }
            const size_t parameter = parameter_of(macro, word, arguments.size());
            if (parameter == arguments.size()) {
                result.push_back({word});
                result.back().word.used = name.used;
                continue;
            }
            if (pasted) {
                append(result, arguments[parameter]);
                continue;
            }
            if (!expanded[parameter])
                expanded[parameter] = expand_argument(arguments[parameter], name, depth);
            append(result, *expanded[parameter]);
        }
        return result;
    }

    static size_t parameter_of(const Macro& macro, const Word& word, size_t none) {
        if (word.kind != TokenKind::identifier)
            return none;
        for (size_t i = 0; i < macro.parameters.size() && i < none; ++i)
            if (macro.parameters[i] == word.text)
                return i;
        return none;
    }

    /// Arguments keep the place where the call spells them.
    void append(Flow& to, const Flow& words) {
        if (words.size() > steps_left_) {
            give_up(words.front().word.used, "its macros make a text that is too long to follow");
            return;
        }
        steps_left_ -= words.size();
        to.insert(to.end(), words.begin(), words.end());
    }

    Flow expand_argument(const Flow& argument, const Word& name, int depth) {
        Flow output;
        if (depth >= k_deepest_arguments) {
            give_up(name.used, "its macros call each other too deeply to follow");
            return output;
        }
        std::vector<Source> sources;
        sources.push_back({&argument});
        expand_all(sources, output, depth + 1);
        for (Source& source : sources)
            if (source.macro)
                source.macro->in_use = false;
        return output;
    }

    /// Applies `left ## right`; `left` is the last word of `result`.
    void paste(Flow& result, const Macro& macro, const std::vector<Flow>& arguments, const Word& right,
               const Word& name) {
        const size_t parameter = parameter_of(macro, right, arguments.size());
        Flow words{{right}};
        words.back().word.used = name.used;
        if (parameter < arguments.size())
            words = arguments[parameter];
        if (words.empty())
            return;
        Word& left = result.back().word;
        if (left.text.size() + words[0].word.text.size() > k_longest_pasted)
            return give_up(name.used, "its macros paste a word that is too long");
        left.text = result_.pasted.emplace_back(std::string(left.text) + std::string(words[0].word.text));
        result.insert(result.end(), words.begin() + 1, words.end());
    }

    const std::vector<Token>& tokens_;
    const Preprocessed& preprocessed_;
    const text::LineMap& lines_;
    std::unordered_map<std::string_view, Macro> macros_;
    size_t steps_left_;
    std::optional<Error> error_;
    Expansion result_;
};

} // namespace

Result<Expansion> expand(const std::vector<Token>& tokens, const Preprocessed& preprocessed,
                         const text::LineMap& lines) {
    return Expander(tokens, preprocessed, lines).run();
}

std::vector<NodeId> SyntaxTree::children(NodeId id) const {
    std::vector<NodeId> ids;
    for (NodeId child = nodes[id].first_child; child != k_no_node; child = nodes[child].next)
        ids.push_back(child);
    return ids;
}

NodeId SyntaxTree::child(NodeId id, size_t index) const {
    NodeId child = nodes[id].first_child;
    while (index-- > 0 && child != k_no_node)
        child = nodes[child].next;
    return child;
}

size_t SyntaxTree::child_count(NodeId id) const {
    size_t count = 0;
    for (NodeId child = nodes[id].first_child; child != k_no_node; child = nodes[child].next)
        ++count;
    return count;
}

NodeId SyntaxTree::around(NodeId id, NodeKind kind) const {
    while (id != k_no_node && nodes[id].kind != kind)
        id = nodes[id].parent;
    return id;
}

bool SyntaxTree::is_within(NodeId id, NodeId ancestor) const {
    // Children are created before their parents, and their words lie within the parent's.
    return ancestor == 0 || (id <= ancestor && nodes[id].begin >= nodes[ancestor].begin &&
                             nodes[id].end <= nodes[ancestor].end);
}

bool is_expression(NodeKind kind) {
    return kind >= NodeKind::name && kind <= NodeKind::braces;
}

bool is_loop(NodeKind kind) {
    return kind == NodeKind::loop_for || kind == NodeKind::loop_while || kind == NodeKind::loop_do;
}

Result<std::unique_ptr<const ParsedText>>
ParsedText::read(text::MappedText source, std::span<const KnownMacro> known, bool all_known) {
    // make_unique cannot call the private constructor
    std::unique_ptr<ParsedText> result(new ParsedText(std::move(source)));
    const text::LineMap& lines = result->source_.lines();
    result->tokens_ = text::tokenize(result->source_.text());
    result->preprocessed_ = preprocess(result->tokens_, known, all_known);
    result->expansion_ = TRY(expand(result->tokens_, result->preprocessed_, lines));
    result->tree_ = TRY(parse(result->expansion_.words, result->tokens_, lines));
    return result;
}

std::string ParsedText::headers() const {
    std::string text;
    for (const size_t hash : expansion_.headers) {
        const size_t end = text::end_of_directive(tokens_, hash);
        for (size_t i = hash; i < end; ++i) {
            text += i > hash && !tokens_[i].glued ? " " : "";
            text += tokens_[i].text;
        }
        text += '\n';
    }
    return text;
}

bool ParsedText::is_es() const {
    return std::ranges::any_of(expansion_.headers, [&](size_t hash) {
        const size_t end = text::end_of_directive(tokens_, hash);
        return tokens_[hash + 1].is("version") && tokens_[end - 1].is("es");
    });
}

SourceLocation ParsedText::place(size_t token) const {
    return source_.lines().locate(tokens_[token].line, tokens_[token].column);
}

std::string ParsedText::excerpt(NodeId id) const {
    const Node& node = tree_[id];
    std::string text;
    for (size_t i = node.begin; i < node.end; ++i) {
        if (i > node.begin && stand_apart(expansion_.words[i - 1], expansion_.words[i]))
            text += ' ';
        text += expansion_.words[i].text;
    }
    return text;
}

/// Decides on a blank as in the author's text if both are neighbours there; else by common style.
bool ParsedText::stand_apart(const Word& left, const Word& right) const {
    const text::Token& token = tokens_[right.spelled];
    const bool neighbours = right.spelled > left.spelled &&
                            tokens_[left.spelled].begin + left.text.size() <= token.begin &&
                            right.spelled - left.spelled <= left.text.size();
    if (neighbours)
        return !token.glued;
    constexpr std::string_view k_sticks_left = ")],;.";
    constexpr std::string_view k_sticks_right = "([.!~";
    if (right.is("(") || right.is("["))
        return left.kind != text::TokenKind::identifier &&
               k_sticks_right.find(left.text.back()) == std::string_view::npos;
    return k_sticks_left.find(right.text[0]) == std::string_view::npos &&
           k_sticks_right.find(left.text.back()) == std::string_view::npos;
}

WordEdits::WordEdits(const ParsedText& text)
    : text_(text), last_before_(text.words().size() + 1),
      first_from_(text.words().size() + 1, uint32_t(text.tokens().size())),
      gone_(text.tokens().size(), false) {
    const std::vector<Word>& words = text.words();
    for (size_t i = 0; i < words.size(); ++i)
        last_before_[i + 1] = std::max(last_before_[i], words[i].used);
    for (size_t i = words.size(); i-- > 0;)
        first_from_[i] = std::min(first_from_[i + 1], words[i].used);
}

/// The tokens up to the next word may include the `)` of a macro call that begins before these words.
bool WordEdits::stands_alone(size_t begin, size_t end) const {
    if (begin >= end || !begins_alone(begin) || last_before_[end] >= first_from_[end])
        return false;
    const std::vector<size_t>& code = text_.preprocessed().code;
    int depth = 0;
    for (auto at = std::lower_bound(code.begin(), code.end(), size_t(first_from_[begin]));
         at != code.end() && *at < first_from_[end]; ++at) {
        const text::Token& token = text_.tokens()[*at];
        depth += nesting(token.text);
        if (depth < 0)
            return false;
    }
    return depth == 0;
}

std::pair<size_t, size_t> WordEdits::tokens_of(size_t begin, size_t end) const {
    const std::vector<size_t>& code = text_.preprocessed().code;
    return {first_from_[begin], *std::prev(std::ranges::lower_bound(code, size_t(first_from_[end])))};
}

void WordEdits::replace(size_t begin, size_t end, std::string_view replacement) {
    const std::vector<text::Token>& tokens = text_.tokens();
    const std::vector<size_t>& code = text_.preprocessed().code;
    const size_t last = first_from_[end];
    std::string text = " " + std::string(replacement) + " "; // keeps the neighbours apart
    auto at = std::lower_bound(code.begin(), code.end(), size_t(first_from_[begin]));
    while (at != code.end() && *at < last) {
        const size_t first = *at;
        size_t token = first;
        gone_[token] = true;
        while (++at != code.end() && *at < last && *at == token + 1)
            gone_[token = *at] = true;
        edits_.push_back({tokens[first].begin, tokens[token].end(), std::move(text)});
        text = " ";
    }
}

void WordEdits::insert(size_t word, std::string_view insertion) {
    edits_.push_back({begin_of(word), begin_of(word), std::string(insertion)});
}

/// Drops edits inside a larger removal, for example a removed branch of a removed function.
text::MappedText WordEdits::apply() const {
    std::vector<text::Edit> edits = edits_;
    std::stable_sort(edits.begin(), edits.end(), [](const text::Edit& a, const text::Edit& b) {
        return a.begin != b.begin ? a.begin < b.begin : a.end > b.end;
    });
    size_t covered = 0;
    std::erase_if(edits, [&covered](const text::Edit& edit) {
        const bool inside = edit.begin < covered;
        covered = std::max(covered, edit.end);
        return inside;
    });
    text::MappedText result = text_.source();
    result.apply(edits);
    return result;
}

int WordEdits::emptied_lines() const {
    const std::vector<text::Token>& tokens = text_.tokens();
    const std::vector<size_t>& code = text_.preprocessed().code;
    int count = 0;
    for (size_t i = 0; i < code.size();) {
        const int line = tokens[code[i]].line;
        bool all_gone = true;
        for (; i < code.size() && tokens[code[i]].line == line; ++i)
            all_gone = all_gone && gone_[code[i]];
        count += all_gone && !text_.source().lines().locate(line).file.empty();
    }
    return count;
}

} // namespace tidemark::glsl
