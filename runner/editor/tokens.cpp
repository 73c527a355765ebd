// Semantic tokens, folding and code actions.

#include "base/tokens.hpp"

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/mapped_text.hpp"
#include "editor/session.hpp"
#include "editor/workspace.hpp"
#include "scene/host_uniforms.hpp"
#include "shader/builtin_functions.hpp"
#include "shader/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>

namespace tidemark::lsp {
namespace {

using text::Token;
using text::TokenKind;

/// Indices of k_type_names.
enum class TokenType { variable, parameter, property, function, macro, structure, type, comment };
constexpr std::string_view k_type_names[] = {"variable", "parameter", "property", "function",
                                             "macro",    "struct",    "type",     "comment"};
/// Bits, in the order of k_modifier_names.
enum Modifier : unsigned { plain = 0, declaration = 1, fixed = 2, given = 4 };
constexpr std::string_view k_modifier_names[] = {"declaration", "readonly", "defaultLibrary"};

struct Marked {
    TokenType type;
    unsigned modifiers = plain;
};

/// Tells what each word of a file is.
class Marker {
public:
    Marker(const Workspace& workspace, const FileNames& names) : workspace_(workspace), names_(names) {
        for (const size_t file : workspace.files_beside(0))
            for (const Symbol& symbol : workspace.files[file].symbols)
                symbols_.try_emplace(symbol.name, &symbol);
        for (const Symbol& symbol : workspace.files.front().symbols)
            declared_.emplace(symbol.name_begin, &symbol);
    }

    std::optional<Marked> mark(size_t i) const {
        const Token& token = names_.tokens()[i];
        if (!names_.reading().active(i))
            return Marked{TokenType::comment};
        if (token.kind != TokenKind::identifier || glsl::is_keyword(token.text))
            return std::nullopt;
        if (names_.is_member(i))
            return Marked{TokenType::property};
        const glsl::MacroLine* const macro = names_.macro_around(i);
        if (macro && names_.is_parameter(*macro, token.text))
            return Marked{TokenType::parameter};
        if (!macro && names_.reading().places[i] == glsl::Place::code)
            if (const Local* local = names_.local(token.text, token.begin))
                return Marked{local->parameter ? TokenType::parameter : TokenType::variable,
                              local->name_begin == token.begin ? declaration : plain};
        const unsigned here = declared_.contains(token.begin) ? declaration : plain;
        if (workspace_.knob(token.text))
            return Marked{TokenType::variable, here | fixed};
        if (const auto symbol = symbols_.find(token.text); symbol != symbols_.end())
            return Marked{type_of(symbol->second->kind),
                          here | (symbol->second->kind == Symbol::Kind::constant ? fixed : plain)};
        if (glsl::find_builtin(token.text))
            return Marked{TokenType::function, given};
        if (glsl::class_of_type(token.text) != glsl::TypeClass::none || glsl::value_type(token.text))
            return Marked{TokenType::type, given};
        if (scene::is_host_uniform(token.text) || token.text.starts_with("gl_"))
            return Marked{TokenType::variable, fixed | given};
        return std::nullopt;
    }

private:
    static TokenType type_of(Symbol::Kind kind) {
        switch (kind) {
        case Symbol::Kind::function: return TokenType::function;
        case Symbol::Kind::structure: return TokenType::structure;
        case Symbol::Kind::macro: return TokenType::macro;
        default: return TokenType::variable;
        }
    }

    const Workspace& workspace_;
    const FileNames& names_;
    std::unordered_map<std::string_view, const Symbol*> symbols_;
    std::unordered_map<size_t, const Symbol*> declared_; ///< by name_begin, of the first file
};

} // namespace

Json semantic_legend() {
    Json types = Json::array(), modifiers = Json::array();
    for (const std::string_view name : k_type_names)
        types.push_back(name);
    for (const std::string_view name : k_modifier_names)
        modifiers.push_back(name);
    return {{"tokenTypes", std::move(types)}, {"tokenModifiers", std::move(modifiers)}};
}

/// Returns the SemanticTokens of the file; words that an #if leaves out are comments.
Answer semantic_tokens(const Question& asked) {
    const SourceFile& file = asked.workspace.files.front();
    const FileNames names(file.text);
    const Marker marker(asked.workspace, names);
    Json data = Json::array();
    int line = 1;         // of the token before
    size_t character = 0; // where that began
    const auto width = [&](size_t begin, size_t end) {
        const std::string_view text = std::string_view(file.text).substr(begin, end - begin);
        return asked.encoding == Encoding::utf8 ? text.size() : text::utf16_length(text);
    };
    size_t measured = 0, at = 0; // the offset up to which a line is measured, and its character
    int measured_line = 0;
    for (size_t i = 0; i < names.tokens().size(); ++i) {
        const auto marked = marker.mark(i);
        const Token& token = names.tokens()[i];
        if (!marked || token.text.find('\n') != token.text.npos)
            continue;
        const size_t begin_of_line = token.begin - size_t(token.column - 1);
        if (measured_line != token.line) {
            measured = begin_of_line;
            at = 0;
            measured_line = token.line;
        }
        at += width(measured, token.begin);
        measured = token.begin;
        const size_t before = token.line == line ? character : 0;
        data.insert(data.end(), {token.line - line, at - before, width(token.begin, token.end()),
                                 int(marked->type), marked->modifiers});
        line = token.line;
        character = at;
    }
    return Json{{"data", std::move(data)}};
}

/// Returns the FoldingRanges: brackets, comments, includes in a row, and #if up to #endif.
Answer folding_ranges(const Question& asked) {
    const std::string& text = asked.workspace.files.front().text;
    const auto tokens = text::tokenize(text);
    Json ranges = Json::array();
    const auto add = [&](int first, int last, const char* kind = nullptr) {
        if (last <= first)
            return;
        Json range{{"startLine", first - 1}, {"endLine", last - 1}};
        if (kind)
            range["kind"] = kind;
        ranges.push_back(std::move(range));
    };
    std::vector<int> braces, conditions;
    int include_first = 0, include_last = -1;
    for (size_t i = 0; i < tokens.size(); ++i) {
        const Token& token = tokens[i];
        if (token.is("{")) {
            braces.push_back(token.line);
        } else if (token.is("}") && !braces.empty()) {
            add(braces.back(), token.line - 1);
            braces.pop_back();
        }
        if (!token.is("#") || !token.first_on_line || i + 1 >= tokens.size())
            continue;
        const std::string_view word = tokens[i + 1].text;
        if (word.starts_with("if")) {
            conditions.push_back(token.line);
        } else if ((word == "else" || word == "elif" || word == "endif") && !conditions.empty()) {
            add(conditions.back(), token.line - 1);
            conditions.back() = token.line;
            if (word == "endif")
                conditions.pop_back();
        } else if (word == "include") {
            if (token.line != include_last + 1) {
                add(include_first, include_last, "imports");
                include_first = token.line;
            }
            include_last = token.line;
        }
    }
    add(include_first, include_last, "imports");
    // Comments are not tokens. A comment is lines that begin with //, or a block.
    int number = 0, first = 0, block = 0;
    for (const std::string_view each : text::lines_of(text)) {
        const std::string_view line = trimmed(each);
        ++number;
        const bool comment = line.starts_with("//") && block == 0;
        if (comment && first == 0)
            first = number;
        if (!comment && first != 0)
            add(std::exchange(first, 0), number - 1, "comment");
        if (block == 0 && line.starts_with("/*"))
            block = number;
        if (block != 0 && line.find("*/") != line.npos)
            add(std::exchange(block, 0), number, "comment");
    }
    if (first != 0)
        add(first, number, "comment");
    return ranges;
}

namespace {

/// A word to change, and what to.
struct Correction {
    size_t begin, end;
    std::string word;
};

/// Reads `'#iUnifrom': did you mean '#iUniform'?`: the wrong word stands in the diagnostic's line.
std::optional<Correction> named_in(const std::string& message, const std::string& text, size_t begin) {
    constexpr std::string_view k_words = "did you mean '";
    const size_t at = message.find(k_words);
    const size_t end = at == message.npos ? at : message.find('\'', at + k_words.size());
    const size_t open = message.find('\'');
    const size_t close = open == message.npos ? open : message.find('\'', open + 1);
    if (end == message.npos || close == message.npos || close > at)
        return std::nullopt;
    const std::string wrong = message.substr(open + 1, close - open - 1);
    const size_t line = begin == 0 ? 0 : text.rfind('\n', begin - 1) + 1;
    const size_t found = text.find(wrong, line);
    if (wrong.empty() || found == text.npos || found > std::min(text.find('\n', line), text.size()))
        return std::nullopt;
    return Correction{found, found + wrong.size(),
                      message.substr(at + k_words.size(), end - at - k_words.size())};
}

/// Returns the nearest name that code may use, for a word that an error calls unknown.
std::optional<Correction> nearest(const Question& asked, const std::string& message, size_t offset) {
    if (message.find("undeclared") == message.npos && message.find("no function with name") == message.npos)
        return std::nullopt;
    const FileNames names(asked.workspace.files.front().text);
    const auto word = word_at(names.tokens(), offset);
    if (!word || message.find(word->text) == message.npos)
        return std::nullopt;
    std::vector<std::string> known;
    for (const Local& local : names.locals())
        if (local.begin <= offset && offset < local.end)
            known.emplace_back(local.name);
    for (const size_t file : asked.workspace.files_beside(0))
        for (const Symbol& symbol : asked.workspace.files[file].symbols)
            known.push_back(symbol.name);
    for (const scene::Knob& knob : asked.workspace.knobs)
        known.push_back(knob.name);
    for (const glsl::BuiltinFunction& function : glsl::builtin_functions())
        known.emplace_back(function.name);
    for (const scene::HostUniform& row : scene::k_host_uniforms)
        known.emplace_back(row.name);
    std::erase(known, word->text);
    const std::string found = nearest_name(word->text, known);
    if (found.empty())
        return std::nullopt;
    return Correction{word->begin, word->end(), found};
}

} // namespace

namespace {

/// A changed line, and the part of it that differs.
struct ChangedLine {
    int line; ///< from 1
    std::string_view before;
    size_t begin, end; ///< of the replaced part, in bytes from the line's beginning
    std::string_view text;
};

/// Returns the changed lines; none if the texts have different numbers of lines.
std::vector<ChangedLine> changed_lines(std::string_view before, std::string_view after) {
    const auto old = text::lines_of(before), now = text::lines_of(after);
    std::vector<ChangedLine> changed;
    for (size_t i = 0; i < old.size() && old.size() == now.size(); ++i) {
        const std::string_view one = old[i], other = now[i];
        if (one == other)
            continue;
        const size_t begin =
            begin_of_character(one, size_t(std::ranges::mismatch(one, other).in1 - one.begin()));
        size_t same = 0; // bytes at the end
        while (same < std::min(one.size(), other.size()) - begin &&
               one[one.size() - 1 - same] == other[other.size() - 1 - same])
            ++same;
        while (same > 0 && continues_character(one[one.size() - same]))
            --same;
        changed.push_back(
            {int(i) + 1, one, begin, one.size() - same, other.substr(begin, other.size() - same - begin)});
    }
    return changed;
}

/// A file as it was measured, and the lines that a change of it touches.
struct ChangedText {
    std::filesystem::path name;
    std::string text; ///< as the editor has it
    std::string before, after;
    std::vector<ChangedLine> lines{}; ///< of `before`
};

ChangedText changed_text(const MeasuredFix::File& file, const std::string& before,
                         const Documents& documents) {
    return {file.name, documents.text_of(file.name).value_or(""), text::with_plain_line_ends(before),
            text::with_plain_line_ends(file.after)};
}

/// Returns the changes of a fix; none if a line that it changes differs from the editor's, since an earlier
/// fix changes it too.
std::deque<ChangedText> changes_of(const MeasuredFix& fix, const Documents& documents) {
    std::deque<ChangedText> changes;
    for (const MeasuredFix::File& file : fix.files) {
        ChangedText& change = changes.emplace_back(changed_text(file, file.before, documents));
        change.lines = changed_lines(change.before, change.after);
        const auto present = text::lines_of(change.text);
        if (change.lines.empty() || std::ranges::any_of(change.lines, [&](const ChangedLine& each) {
                return size_t(each.line) > present.size() || present[size_t(each.line) - 1] != each.before;
            }))
            return {};
    }
    return changes;
}

/// Returns the changes of all fixes together.
std::deque<ChangedText> changes_of(const std::vector<MeasuredFix>& fixes, const Documents& documents) {
    std::deque<ChangedText> changes;
    for (const MeasuredFix& fix : fixes)
        for (const MeasuredFix::File& file : fix.files) {
            const auto known = std::ranges::find(changes, file.name, &ChangedText::name);
            if (known == changes.end())
                changes.push_back(changed_text(file, file.before, documents));
            else
                known->after = text::with_plain_line_ends(file.after);
        }
    for (ChangedText& change : changes)
        change.lines = changed_lines(change.before, change.after);
    return changes;
}

/// Returns a WorkspaceEdit.
Json edit_of(const std::deque<ChangedText>& changes, const Question& asked, bool versioned) {
    Json files = versioned ? Json::array() : Json::object();
    for (const ChangedText& change : changes) {
        const Lines lines(change.text, asked.encoding);
        Json edits = Json::array();
        for (const ChangedLine& each : change.lines) {
            const size_t begin = lines.begin_of(each.line);
            edits.push_back(
                {{"range", lines.range(begin + each.begin, begin + each.end)}, {"newText", each.text}});
        }
        const std::string uri = asked.documents.uri_of(change.name);
        const Document* const open = asked.documents.find(change.name);
        if (!versioned)
            files[uri] = std::move(edits);
        else
            files.push_back(
                {{"textDocument", {{"uri", uri}, {"version", open ? Json(open->version) : Json()}}},
                 {"edits", std::move(edits)}});
    }
    return {{versioned ? "documentChanges" : "changes", std::move(files)}};
}

/// Returns whether one of the changed lines is in the request's range.
bool touches(const std::deque<ChangedText>& changes, const Question& asked) {
    const Json& range = asked.params.at("range");
    const int first = range.at("start").at("line").get<int>() + 1;
    const int last = range.at("end").at("line").get<int>() + 1;
    return std::ranges::any_of(changes, [&](const ChangedText& change) {
        return change.name == asked.workspace.files.front().path &&
               std::ranges::any_of(change.lines, [&](const ChangedLine& each) {
                   return first <= each.line && each.line <= last;
               });
    });
}

} // namespace

Json fix_actions(const Question& asked, const std::vector<MeasuredFix>& fixes, bool versioned) {
    Json actions = Json::array();
    const auto add = [&](std::string title, const std::deque<ChangedText>& changes) {
        actions.push_back({{"title", std::move(title)},
                           {"kind", "quickfix"},
                           {"edit", edit_of(changes, asked, versioned)}});
    };
    for (const MeasuredFix& fix : fixes)
        if (const auto changes = changes_of(fix, asked.documents); touches(changes, asked))
            add("Fix: " + fix.title, changes);
    if (fixes.size() > 1)
        if (const auto changes = changes_of(fixes, asked.documents); touches(changes, asked))
            add(fmt::format("Apply all {} measured fixes", fixes.size()), changes);
    return actions;
}

std::vector<Diagnostic> fix_hints(const std::vector<MeasuredFix>& fixes, const Documents& documents) {
    std::vector<Diagnostic> hints;
    for (const MeasuredFix& fix : fixes)
        for (const ChangedText& change : changes_of(fix, documents))
            for (const ChangedLine& each : change.lines)
                hints.push_back(
                    {{change.name.string(), each.line, int(each.begin) + 1}, Severity::note, fix.report});
    return hints;
}

/// Returns the CodeActions for the diagnostics at the cursor: a misspelt word becomes the nearest known one.
Answer code_actions(const Question& asked) {
    constexpr size_t k_most_diagnostics = 20;
    Json actions = Json::array();
    const SourceFile& file = asked.workspace.files.front();
    const Lines lines(file.text, asked.encoding);
    const Json& diagnostics = asked.params.at("context").at("diagnostics");
    for (size_t i = 0; i < std::min(diagnostics.size(), k_most_diagnostics); ++i) {
        const auto message = diagnostics.at(i).at("message").get<std::string>();
        const size_t begin = lines.offset(diagnostics.at(i).at("range").at("start"));
        auto correction = named_in(message, file.text, begin);
        if (!correction)
            correction = nearest(asked, message, begin);
        if (!correction)
            continue;
        Json changes = Json::object();
        changes[asked.documents.uri_of(file.path)] = Json::array(
            {{{"range", lines.range(correction->begin, correction->end)}, {"newText", correction->word}}});
        actions.push_back({{"title", fmt::format("Change to '{}'", correction->word)},
                           {"kind", "quickfix"},
                           {"isPreferred", true},
                           {"diagnostics", Json::array({diagnostics.at(i)})},
                           {"edit", {{"changes", std::move(changes)}}}});
    }
    return actions;
}

} // namespace tidemark::lsp
