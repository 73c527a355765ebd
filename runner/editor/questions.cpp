// Answers requests of an editor about a place in a document.

#include "base/error.hpp"
#include "editor/session.hpp"
#include "editor/workspace.hpp"
#include "scene/host_uniforms.hpp"
#include "shader/builtin_functions.hpp"
#include "shader/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tidemark::lsp {
namespace {

/// Returns begin and end (offsets) of the default in a knob's line: after the `=`, through the first `)` or
/// the last token. Returns nothing without a default.
std::optional<std::pair<size_t, size_t>> default_of(const Symbol& symbol, std::string_view text) {
    const std::string_view line = text.substr(symbol.begin, symbol.end - symbol.begin);
    const auto tokens = text::tokenize(line);
    const auto equals = std::ranges::find_if(tokens, [](const text::Token& token) { return token.is("="); });
    if (equals == tokens.end() || equals + 1 == tokens.end())
        return std::nullopt;
    const auto close =
        std::find_if(equals, tokens.end(), [](const text::Token& token) { return token.is(")"); });
    const auto last = close == tokens.end() ? tokens.end() - 1 : close;
    return std::pair(symbol.begin + (equals + 1)->begin, symbol.begin + last->end());
}

Json colour_of(const scene::KnobValue& value) {
    const auto part = [](double number) { return std::clamp(number, 0.0, 1.0); };
    return {{"red", part(value[0])}, {"green", part(value[1])}, {"blue", part(value[2])}, {"alpha", 1}};
}

/// Rounds to three decimals, which is finer than a byte's 255 steps.
double rounded(const Json& number) {
    return std::round(number.get<double>() * 1000) / 1000;
}

/// Returns the ColorInformations of the first file.
Answer document_colours(const Question& asked) {
    Json colours = Json::array();
    const SourceFile& file = asked.workspace.files.front();
    const Lines lines(file.text, asked.encoding);
    for (const Symbol& symbol : file.symbols) {
        const scene::Knob* knob =
            symbol.kind == Symbol::Kind::knob ? asked.workspace.knob(symbol.name) : nullptr;
        if (!knob || knob->type != scene::KnobType::color3)
            continue;
        if (const auto range = default_of(symbol, file.text))
            colours.push_back(
                {{"range", lines.range(range->first, range->second)}, {"color", colour_of(knob->initial)}});
    }
    return colours;
}

/// Returns the ColorPresentations of a Color: `color3(1, 0.5, 0)`.
Answer colour_presentations(const Question& asked) {
    const Json& colour = asked.params.at("color");
    const scene::Knob knob{
        .name = {},
        .type = scene::KnobType::color3,
        .value = {rounded(colour.at("red")), rounded(colour.at("green")), rounded(colour.at("blue")), 0}};
    const std::string literal = scene::to_literal(knob);
    return Json::array(
        {{{"label", literal}, {"textEdit", {{"range", asked.params.at("range")}, {"newText", literal}}}}});
}

std::string code(std::string_view text) {
    return fmt::format("```glsl\n{}\n```\n", text);
}

std::string of_knob(const scene::Knob& knob) {
    std::string text = code(fmt::format("uniform {} {}", info(knob.type).glsl_name, knob.name));
    text += fmt::format("Knob, initially {}", scene::to_string(knob, knob.initial));
    if (knob.range)
        text += fmt::format(", from {} to {}", scene::to_string(knob, knob.range->low),
                            scene::to_string(knob, knob.range->high));
    if (knob.step)
        text += fmt::format(", in steps of {}", scene::to_string(knob, *knob.step));
    return text + ".\n";
}

/// Signatures in one hover text; functions of vectors have one for each vector size.
constexpr size_t k_most_signatures = 8;

std::string of_builtin(const glsl::BuiltinFunction& function) {
    std::string signatures;
    const auto overloads = glsl::overloads_of(function);
    for (size_t i = 0; i < std::min(overloads.size(), k_most_signatures); ++i)
        signatures += (i > 0 ? "\n" : "") + signature(function, overloads[i]);
    if (overloads.size() > k_most_signatures)
        signatures += fmt::format("\n// and {} more", overloads.size() - k_most_signatures);
    std::string text = code(signatures);
    if (function.domain)
        for (const glsl::UndefinedWhere& where : function.domain->undefined)
            if (!where.fault.empty())
                text += fmt::format("Undefined {}.\n", where.fault);
    if (!function.in_es())
        text += fmt::format("Not in GLSL ES 3.00, which ShaderToy's site compiles: {}.\n", function.instead);
    return text;
}

std::string of_symbol(const SourceFile& file, const Symbol& symbol, bool elsewhere) {
    std::string text = code(symbol.signature);
    if (!symbol.comment.empty())
        text += symbol.comment + "\n";
    if (elsewhere)
        text += fmt::format("\nFrom `{}`.\n", file.path.filename().string());
    return text;
}

/// Describes a channel. Leaves out the sampler type, which depends on the input that the pass reads.
std::string of_channel(std::string_view name) {
    return fmt::format("Input {} of the pass: a texture, a video, the keyboard, a cubemap or another pass, "
                       "as `#{} \"…\"` or the scene's channels name it.\n",
                       name.back(), name);
}

/// Describes a uniform that this host adds to ShaderToy's; empty for other names.
std::string of_own_uniform(std::string_view name) {
    const scene::HostUniform* row = scene::find_host_uniform(name);
    return row && row->declared != scene::Declared::by_site
               ? fmt::format("Given by this host: {}.\n", row->meaning)
               : "";
}

std::string of_host(std::string_view name) {
    if (std::ranges::find(scene::k_channel_names, name) != scene::k_channel_names.end())
        return of_channel(name);
    const scene::HostUniform* row = scene::find_host_uniform(name);
    if (!row || row->declared != scene::Declared::by_site)
        return of_own_uniform(name);
    const std::string length = row->length > 0 ? fmt::format("[{}]", row->length) : "";
    return code(fmt::format("uniform {} {}{}", row->type, name, length)) +
           fmt::format("Given by the host, as on ShaderToy's site: {}.\n", row->meaning);
}

/// Returns Markdown: a knob's value and range, a declaration with the comment above it, a built-in function's
/// signatures and the cases where it is undefined, a uniform of the host, or the first comment of an included
/// file. Empty where nothing is known.
std::string hover_text(const Workspace& workspace, size_t offset, const Documents& documents) {
    if (const auto included = included_at(workspace, offset); !included.empty()) {
        const auto text = documents.text_of(included);
        return text && workspace.may_read(included)
                   ? fmt::format("`{}`\n\n{}\n", included.string(), leading_comment(*text))
                   : "";
    }
    const auto tokens = text::tokenize(workspace.files.front().text);
    const auto word = word_at(tokens, offset);
    if (!word)
        return {};
    if (const scene::Knob* knob = workspace.knob(word->text))
        return of_knob(*knob);
    std::string text;
    for (const SourceFile& file : workspace.files)
        for (const Symbol& symbol : file.symbols)
            if (symbol.name == word->text)
                text += of_symbol(file, symbol, &file != &workspace.files.front());
    if (!text.empty())
        return text + of_own_uniform(word->text);
    if (const glsl::BuiltinFunction* function = glsl::find_builtin(word->text))
        return of_builtin(*function);
    const auto old = std::ranges::find(glsl::k_old_names, word->text, &glsl::OldName::name);
    if (old == std::end(glsl::k_old_names))
        return of_host(word->text);
    const glsl::BuiltinFunction* const today = glsl::find_builtin(old->today);
    return fmt::format("An older name of `{}`.\n\n", old->today) +
           (today ? of_builtin(*today) : of_host(old->today));
}

/// Returns the protocol's SymbolKind.
int number_of(Symbol::Kind kind) {
    switch (kind) {
    case Symbol::Kind::function: return 12;
    case Symbol::Kind::variable: return 13;
    case Symbol::Kind::constant: return 14;
    case Symbol::Kind::structure: return 23;
    case Symbol::Kind::macro: return 14;
    case Symbol::Kind::knob: return 7; // Property
    }
    return 13;
}

/// Returns Locations: the declarations of a name, all overloads included; for an `#include` the file.
Answer definitions(const Question& asked) {
    Json found = Json::array();
    if (const auto included = included_at(asked.workspace, asked.offset()); !included.empty()) {
        if (asked.documents.text_of(included))
            found.push_back({{"uri", asked.documents.uri_of(included)},
                             {"range", Lines("", asked.encoding).range(0, 0)}});
        return found;
    }
    const auto tokens = text::tokenize(asked.workspace.files.front().text);
    const auto word = word_at(tokens, asked.offset());
    for (const SourceFile& file : asked.workspace.files) {
        const Lines lines(file.text, asked.encoding);
        for (const Symbol& symbol : file.symbols)
            if (word && symbol.name == word->text)
                found.push_back({{"uri", asked.documents.uri_of(file.path)},
                                 {"range", lines.range(symbol.name_begin, symbol.name_end())}});
    }
    return found;
}

/// Returns the DocumentSymbols of the first file.
Answer document_symbols(const Question& asked) {
    const SourceFile& file = asked.workspace.files.front();
    const Lines lines(file.text, asked.encoding);
    Json symbols = Json::array();
    for (const Symbol& symbol : file.symbols)
        symbols.push_back({{"name", symbol.name},
                           {"detail", symbol.signature},
                           {"kind", number_of(symbol.kind)},
                           {"range", lines.range(symbol.begin, symbol.end)},
                           {"selectionRange", lines.range(symbol.name_begin, symbol.name_end())}});
    return symbols;
}

Answer hover(const Question& asked) {
    const std::string text = hover_text(asked.workspace, asked.offset(), asked.documents);
    return text.empty() ? Json() : Json{{"contents", {{"kind", "markdown"}, {"value", text}}}};
}

constexpr std::pair<std::string_view, AnswerTo> k_questions[] = {
    {"textDocument/hover", hover},
    {"textDocument/definition", definitions},
    {"textDocument/documentSymbol", document_symbols},
    {"textDocument/documentColor", document_colours},
    {"textDocument/colorPresentation", colour_presentations},
    {"textDocument/prepareRename", renamed_range},
    {"textDocument/rename", rename},
    {"textDocument/references", references},
    {"textDocument/documentHighlight", highlights},
    {"textDocument/completion", completions},
    {"textDocument/signatureHelp", signature_help},
    {"textDocument/semanticTokens/full", semantic_tokens},
    {"textDocument/foldingRange", folding_ranges},
    {"textDocument/codeAction", code_actions},
};

} // namespace

std::string signature(const glsl::BuiltinFunction& function, const glsl::BuiltinOverload& overload) {
    std::string parameters;
    for (const glsl::BuiltinParameter& parameter : overload.parameters)
        parameters += fmt::format("{}{}{}", parameters.empty() ? "" : ", ", parameter.written ? "out " : "",
                                  parameter.type);
    return fmt::format("{} {}({})", overload.result, function.name, parameters);
}

std::string describe_builtin(std::string_view name) {
    const glsl::BuiltinFunction* const function = glsl::find_builtin(name);
    return function ? of_builtin(*function) : "";
}

std::string describe_host(std::string_view name) {
    return of_host(name);
}

/// Returns the SignatureHelp for the call around the cursor; null outside of calls.
Answer signature_help(const Question& asked) {
    const SourceFile& file = asked.workspace.files.front();
    const auto tokens = text::tokenize(file.text);
    const size_t offset = asked.offset();
    size_t i = size_t(std::ranges::lower_bound(tokens, offset, {}, &text::Token::begin) - tokens.begin());
    int depth = 0;
    size_t commas = 0;
    bool found = false;
    while (i-- > 0) {
        const int nesting = glsl::nesting(tokens[i].text);
        if (tokens[i].is(";") || tokens[i].is("{") || tokens[i].is("}"))
            return Json();
        depth += nesting;
        if (depth > 0 && tokens[i].is("(") && i > 0 && tokens[i - 1].kind == text::TokenKind::identifier) {
            found = true;
            break;
        }
        if (depth > 0) { // a bracket without a callee: its commas do not count
            depth = 0;
            commas = 0;
        }
        commas += depth == 0 && tokens[i].is(",") ? 1 : 0;
    }
    if (!found)
        return Json();
    const std::string_view name = tokens[i - 1].text;
    Json signatures = Json::array();
    std::optional<size_t> active;
    const auto add = [&](const std::string& label, const std::string& about) {
        const size_t open = label.find('('), close = label.rfind(')');
        Json parameters = Json::array();
        int nesting = 0;
        size_t begin = open + 1;
        for (size_t at = open + 1; open != label.npos && close != label.npos && at <= close; ++at) {
            nesting += at < close ? glsl::nesting(std::string_view(label).substr(at, 1)) : 0;
            if (nesting != 0 || (at < close && label[at] != ','))
                continue;
            while (begin < at && label[begin] == ' ')
                ++begin;
            if (begin < at)
                parameters.push_back({{"label", label.substr(begin, at - begin)}});
            begin = at + 1;
        }
        if (!active && (parameters.size() > commas || (parameters.empty() && commas == 0)))
            active = signatures.size();
        Json signature{{"label", label}, {"parameters", std::move(parameters)}};
        if (!about.empty())
            signature["documentation"] = {{"kind", "markdown"}, {"value", about}};
        signatures.push_back(std::move(signature));
    };
    for (const size_t beside : asked.workspace.files_beside(0))
        for (const Symbol& symbol : asked.workspace.files[beside].symbols)
            if (symbol.name == name &&
                (symbol.kind == Symbol::Kind::function ||
                 (symbol.kind == Symbol::Kind::macro && symbol.signature.find('(') != std::string::npos)))
                add(symbol.signature, symbol.comment);
    if (const glsl::BuiltinFunction* function = signatures.empty() ? glsl::find_builtin(name) : nullptr)
        for (const glsl::BuiltinOverload& overload : glsl::overloads_of(*function)) {
            std::string about;
            if (function->domain)
                for (const glsl::UndefinedWhere& where : function->domain->undefined)
                    if (!where.fault.empty())
                        about += fmt::format("Undefined {}.\n", where.fault);
            add(signature(*function, overload), about);
        }
    if (signatures.empty())
        return Json();
    return Json{{"signatures", std::move(signatures)},
                {"activeSignature", active.value_or(0)},
                {"activeParameter", commas}};
}

tl::unexpected<Refusal> refuse(ErrorNumber number, std::string message) {
    return tl::unexpected<Refusal>(Refusal{number, std::move(message)});
}

size_t Question::offset() const {
    return Lines(workspace.files.front().text, encoding).offset(params.at("position"));
}

AnswerTo find_question(std::string_view method) {
    const auto known = std::ranges::find(k_questions, method, &std::pair<std::string_view, AnswerTo>::first);
    return known == std::end(k_questions) ? nullptr : known->second;
}

} // namespace tidemark::lsp
