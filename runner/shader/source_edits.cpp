#include "shader/source_edits.hpp"

#include "base/tokens.hpp"
#include "shader/builtin_functions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace tidemark::glsl {
namespace {

/// A wrap at one of the places where its tokens are.
struct Placed {
    size_t begin = 0, end = 0;
    const Wrap* wrap = nullptr;
    size_t cure = 0;

    bool encloses(const Placed& other) const {
        const bool same = begin == other.begin && end == other.end;
        return begin <= other.begin && other.end <= end && (!same || cure > other.cure);
    }
    bool overlaps(const Placed& other) const { return begin < other.end && other.begin < end; }
};

/// One insertion. Insertions at one place are ordered: end of an inner wrap, end of an outer one, start of an
/// outer one, start of an inner one. Of two wraps around the same tokens, the later cure is the outer one.
struct Insertion {
    size_t at = 0;
    bool front = false;
    size_t other = 0; ///< position of the other half of its wrap
    std::string_view text{};
    size_t cure = 0;
    size_t until = 0; ///< the text up to here is removed

    bool stands_before(const Insertion& next) const {
        if (at != next.at)
            return at < next.at;
        if (front != next.front)
            return next.front;
        return other != next.other ? other > next.other : front ? cure > next.cure : cure < next.cure;
    }
};

std::vector<text::Edit> edits_of(const std::vector<Placed>& wraps) {
    std::vector<Insertion> insertions;
    for (const Placed& each : wraps) {
        const size_t until = each.wrap->replaces ? each.end : each.begin;
        insertions.push_back({each.begin, true, each.end, each.wrap->front, each.cure, until});
        insertions.push_back({each.end, false, each.begin, each.wrap->behind, each.cure, each.end});
    }
    std::ranges::stable_sort(insertions, [](const auto& a, const auto& b) { return a.stands_before(b); });
    std::vector<text::Edit> edits;
    for (const Insertion& each : insertions)
        edits.push_back({each.at, each.until, std::string(each.text)});
    return edits;
}

/// Removes wraps whose text another wrap replaces. Returns false if two overlap and neither is inside the
/// other.
bool leave_out_replaced(std::vector<Placed>& wraps) {
    const std::vector<Placed> all = wraps;
    std::erase_if(wraps, [&](const Placed& each) {
        return std::ranges::any_of(all, [&](const Placed& other) {
            return other.wrap->replaces && other.wrap != each.wrap && other.encloses(each);
        });
    });
    return std::ranges::none_of(wraps, [&](const Placed& each) {
        return each.wrap->replaces && std::ranges::any_of(wraps, [&](const Placed& other) {
                   return other.wrap != each.wrap && each.overlaps(other) && !other.encloses(each);
               });
    });
}

/// Finds the lines of a text by their file and line number in the author's files.
class Lines {
public:
    explicit Lines(const text::MappedText& text) : text_(text) {
        int number = 0;
        for (const std::string_view line : text::lines_of(text.text())) {
            const SourceLocation where = text.lines().locate(++number);
            lines_[{where.file, where.line}].push_back({number, line});
        }
    }

    /// Returns every offset of the token. A file may be in the text more than once.
    std::vector<size_t> find(const WrittenWord& wanted) const {
        std::vector<size_t> found;
        const auto lines = lines_.find({wanted.where.file, wanted.where.line});
        if (lines == lines_.end())
            return found;
        for (const Line& line : lines->second)
            for (size_t i = line.text.find(wanted.word); i != line.text.npos;
                 i = line.text.find(wanted.word, i + 1))
                if (text_.lines().locate(line.number, int(i) + 1).column == wanted.where.column) {
                    found.push_back(size_t(line.text.data() - text_.text().data()) + i);
                    break;
                }
        return found;
    }

private:
    struct Line {
        int number;
        std::string_view text;
    };
    const text::MappedText& text_;
    std::map<std::pair<std::string, int>, std::vector<Line>> lines_;
};

/// Returns nothing if a wrap's first and last tokens do not occur equally often.
std::optional<std::vector<Placed>> placed(const Lines& lines, std::span<const Cure> cures) {
    std::vector<Placed> all;
    for (size_t number = 0; number < cures.size(); ++number)
        for (const Wrap& wrap : cures[number].wraps) {
            const auto begins = lines.find(wrap.first), ends = lines.find(wrap.last);
            if (begins.size() != ends.size())
                return std::nullopt;
            for (size_t i = 0; i < begins.size(); ++i)
                all.push_back({begins[i], ends[i] + wrap.last.word.size(), &wrap, number});
        }
    return all;
}

/// Returns the text with LF for every CR that ends a line alone; other line ends stay.
std::string with_line_feeds(std::string_view text) {
    std::string result(text);
    for (size_t i = 0; i < result.size(); ++i)
        if (result[i] == '\r' && (i + 1 == result.size() || result[i + 1] != '\n'))
            result[i] = '\n';
    return result;
}

/// Restores the original's line ends; both texts have the same number of lines.
void restore_line_ends(std::string& text, std::string_view original) {
    size_t i = 0;
    for (char& c : text) {
        if (c != '\n')
            continue;
        i = original.find_first_of("\r\n", i);
        if (i == original.npos)
            return;
        if (original.substr(i).starts_with("\r\n"))
            ++i; // the text still has the CR before it
        c = original[i++];
    }
}

} // namespace

std::optional<std::string> cured(std::string_view text, std::string_view file, std::span<const Cure> cures) {
    text::MappedText whole;
    const std::string plain = with_line_feeds(text);
    whole.append(plain, file, 1);
    const bool has_end = plain.ends_with('\n');
    if (!apply(whole, cures))
        return std::nullopt;
    std::string result = whole.text();
    if (!has_end && result.ends_with('\n'))
        result.pop_back();
    if (plain != text)
        restore_line_ends(result, text);
    return result;
}

bool apply(text::MappedText& text, std::span<const Cure> cures) {
    auto wraps = placed(Lines(text), cures);
    if (!wraps || !leave_out_replaced(*wraps))
        return false;
    text.apply(edits_of(*wraps));
    return true;
}

namespace {

constexpr size_t k_longest_repeated = 60;

SourceLocation place_of(const ParsedText& text, size_t token) {
    const text::Token& at = text.tokens()[token];
    return text.source().lines().locate(at.line, at.column);
}

bool has_no_effect(const ParsedText& text, const TreeFacts& facts, NodeId id) {
    const SyntaxTree& tree = text.tree();
    const Node& node = tree[id];
    const std::string_view word = text.word(node.word);
    if (node.kind == NodeKind::assign || node.kind == NodeKind::postfix || word == "++" || word == "--")
        return false;
    if (node.kind == NodeKind::call) {
        const std::string_view name = called_name(text, id);
        const BuiltinFunction* const function = find_builtin(name);
        const bool only_reads = function && (function->is(Trait::pure) || function->is(Trait::derivative) ||
                                             function->is(Trait::implicit_lod));
        if (facts.function(name) || !(facts.is_type(name) || only_reads))
            return false;
    }
    for (NodeId child = node.first_child; child != k_no_node; child = tree[child].next)
        if (!has_no_effect(text, facts, child))
            return false;
    return true;
}

/// Returns the tokens between two separators of the call, whatever macros the argument is made of.
std::optional<WrittenTokens> between_signs(const ParsedText& text, const Node& argument) {
    const Word &before = text.words()[argument.begin - 1], &behind = text.words()[argument.end];
    if (before.from_macro() != behind.from_macro() || before.spelled + 1 >= behind.spelled ||
        (before.from_macro() && before.used != behind.used))
        return std::nullopt;
    return WrittenTokens{before.spelled + 1u, behind.spelled - 1u};
}

std::optional<WrittenTokens> edges(const ParsedText& text, const Node& node, bool in_macro) {
    const Word &first = text.words()[node.begin], &last = text.words()[node.end - 1];
    if (!in_macro) {
        const bool takes_arguments = last.from_macro() && last.used + 1u < text.tokens().size() &&
                                     text.tokens()[last.used + 1u].is("(");
        return takes_arguments ? std::nullopt : std::optional(WrittenTokens{first.used, last.used});
    }
    if (!first.from_macro() || !last.from_macro() || first.used != last.used || first.spelled > last.spelled)
        return std::nullopt;
    return WrittenTokens{first.spelled, last.spelled};
}

} // namespace

std::optional<WrittenTokens> written_for(const ParsedText& text, NodeId id, NodeId operation) {
    const SyntaxTree& tree = text.tree();
    const bool in_macro = text.words()[tree[operation].word].from_macro();
    const bool is_argument = id != operation && tree[operation].kind == NodeKind::call;
    const auto tokens = is_argument ? between_signs(text, tree[id]) : edges(text, tree[id], in_macro);
    if (!tokens)
        return std::nullopt;
    const SourceLocation from = place_of(text, tokens->first), to = place_of(text, tokens->last);
    // A macro's body that spans several joined lines is left as it is.
    if (from.file.empty() || from.file != to.file || (in_macro && from.line != to.line))
        return std::nullopt;
    return tokens;
}

Wrap wrapped(const ParsedText& text, WrittenTokens tokens, std::string front, std::string behind) {
    const auto word = [&](size_t token) {
        return WrittenWord{place_of(text, token), std::string(text.tokens()[token].text)};
    };
    return {word(tokens.first), word(tokens.last), std::move(front), std::move(behind)};
}

Wrap in_place_of(const ParsedText& text, WrittenTokens tokens, std::string instead) {
    Wrap wrap = wrapped(text, tokens, std::move(instead), "");
    wrap.replaces = true;
    return wrap;
}

NodeId body_of_function(const ParsedText& text, NodeId function) {
    const SyntaxTree& tree = text.tree();
    for (const NodeId part : tree.children(function))
        if (tree[part].kind == NodeKind::block)
            return part;
    return k_no_node;
}

std::vector<NodeId> parameters_of(const ParsedText& text, NodeId function) {
    std::vector<NodeId> parameters;
    for (const NodeId part : text.tree().children(function))
        if (text.tree()[part].kind == NodeKind::parameter)
            parameters.push_back(part);
    return parameters;
}

NodeId find_main_image(const ParsedText& text) {
    for (NodeId id = 1; id < text.tree().nodes.size(); ++id)
        if (text.tree()[id].kind == NodeKind::function && text.word_of(id) == "mainImage" &&
            body_of_function(text, id) != k_no_node)
            return id;
    return k_no_node;
}

std::optional<Wrap> at_word(const ParsedText& text, size_t word, std::string front, std::string behind) {
    const Word& at = text.words()[word];
    if (at.from_macro() || text.spelled(word).file.empty())
        return std::nullopt;
    return wrapped(text, {at.spelled, at.spelled}, std::move(front), std::move(behind));
}

std::string fresh_name(const ParsedText& text, std::string_view wanted, size_t number) {
    for (;; ++number) {
        std::string name = std::string(wanted) + (number == 1 ? "" : std::to_string(number));
        if (std::ranges::none_of(text.words(), [&](const Word& word) { return word.text == name; }))
            return name;
    }
}

std::optional<std::string> said_again(const ParsedText& text, const TreeFacts& facts, NodeId id,
                                      WrittenTokens tokens) {
    const text::Token &first = text.tokens()[tokens.first], &last = text.tokens()[tokens.last];
    const std::string_view words =
        std::string_view(text.source().text()).substr(first.begin, last.end() - first.begin);
    if (words.size() > k_longest_repeated || first.line != last.line || words.find("//") != words.npos ||
        !has_no_effect(text, facts, id))
        return std::nullopt;
    return std::string(words);
}

void SourceRewriter::wrap(NodeId node, std::string_view before, std::string_view after) {
    const Node& words = text_.tree()[node];
    std::string& front = changes_[words.begin].before;
    front.insert(0, before);
    changes_[words.end - 1].after += after;
}

std::string SourceRewriter::text() const {
    std::string result;
    for (size_t i = 0; i < changes_.size(); ++i) {
        const Change& change = changes_[i];
        const std::string_view word = text_.word(i);
        result += change.before;
        result += change.replacement.empty() ? word : std::string_view(change.replacement);
        result += change.after;
        result += word == ";" || word == "{" ? '\n' : ' ';
    }
    return result;
}

std::string words_of(const ParsedText& text, NodeId id) {
    std::string words;
    for (size_t i = text.tree()[id].begin; i < text.tree()[id].end; ++i)
        words += fmt::format("{} ", text.word(i));
    return words;
}

std::string fresh_prefix(const ParsedText& text) {
    for (int n = 0;; ++n) {
        std::string prefix = fmt::format("tmw{}_", n);
        if (std::ranges::none_of(text.words(),
                                 [&](const Word& word) { return word.text.starts_with(prefix); }))
            return prefix;
    }
}

std::string headers_with_buffers(const ParsedText& text) {
    std::string headers = text.headers();
    const size_t es = headers.find("#version 300 es");
    if (es != headers.npos)
        return headers.replace(es, 15, "#version 310 es") + "precision highp float;\nprecision highp int;\n";
    return headers + "#extension GL_ARB_shader_storage_buffer_object : enable\n"
                     "#extension GL_ARB_shading_language_420pack : enable\n"
                     "#extension GL_ARB_shader_bit_encoding : enable\n";
}

std::string spell(std::string_view pattern, std::string_view prefix, std::string_view type) {
    std::string text;
    for (const char c : pattern) {
        if (c == '$')
            text += prefix;
        else if (c == '@')
            text += type;
        else
            text += c;
    }
    return text;
}

} // namespace tidemark::glsl
