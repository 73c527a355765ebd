#include "lsp/rename.hpp"

#include "glsl/syntax/builtin_functions.hpp"
#include "glsl/syntax/types.hpp"
#include "glsl/syntax/words.hpp"
#include "scene/host_uniforms.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::lsp {
namespace {

using text::Token;

std::optional<Token> knob_at(const Workspace& workspace, const std::vector<Token>& tokens, size_t offset) {
    const auto word = word_at(tokens, offset);
    return word && workspace.knob(word->text) ? word : std::nullopt;
}

/// Returns the tokens that use the name; after a dot it is a member and does not count.
std::vector<const Token*> uses_of(const std::vector<Token>& tokens, std::string_view name) {
    std::vector<const Token*> uses;
    for (size_t i = 0; i < tokens.size(); ++i)
        if (tokens[i].kind == text::TokenKind::identifier && tokens[i].is(name) &&
            (i == 0 || !tokens[i - 1].is(".")))
            uses.push_back(&tokens[i]);
    return uses;
}

constexpr std::string_view k_entry_points[] = {"main",        "mainImage", "mainSound",
                                               "mainCubemap", "mainHit",   "mainVR"};

/// Returns the reason why a knob cannot have that name; empty: it can.
std::string why_not(const Workspace& workspace, const std::string& name) {
    const auto tokens = text::tokenize(name);
    if (tokens.size() != 1 || tokens.front().kind != text::TokenKind::identifier ||
        tokens.front().text.size() != name.size())
        return "it is no name of GLSL";
    if (name.starts_with("gl_") || name.find("__") != name.npos || glsl::find_builtin(name) ||
        glsl::is_keyword(name) || glsl::is_one_of(name, glsl::k_reserved_words) || glsl::value_type(name) ||
        scene::is_host_uniform(name) || name.starts_with("tidemark_") ||
        glsl::is_one_of(name, k_entry_points))
        return "the name is GLSL's or the host's";
    for (const SourceFile& file : workspace.files)
        if (!uses_of(text::tokenize(file.text), name).empty())
            return fmt::format("'{}' has that name already", file.path.filename().string());
    return {};
}

} // namespace

Json renamed_range(const Workspace& workspace, size_t offset, Encoding encoding) {
    const std::string& text = workspace.files.front().text;
    const auto tokens = text::tokenize(text);
    const auto knob = knob_at(workspace, tokens, offset);
    return knob ? Lines(text, encoding).range(knob->begin, knob->end()) : Json();
}

Result<Json> rename_knob(const Workspace& workspace, size_t offset, const std::string& name,
                         const Documents& documents, Encoding encoding) {
    const auto tokens = text::tokenize(workspace.files.front().text);
    const auto knob = knob_at(workspace, tokens, offset);
    if (!knob)
        return fail(ErrorCode::usage, "only knobs (#iUniform) can be renamed: no knob stands here");
    if (const std::string why = why_not(workspace, name); !why.empty())
        return fail(ErrorCode::usage, fmt::format("'{}' cannot be called '{}': {}", knob->text, name, why));
    Json changes = Json::object();
    for (const SourceFile& file : workspace.files) {
        const Lines lines(file.text, encoding);
        const auto words = text::tokenize(file.text);
        for (const Token* use : uses_of(words, knob->text))
            changes[documents.uri_of(file.path)].push_back(
                {{"range", lines.range(use->begin, use->end())}, {"newText", name}});
    }
    return Json{{"changes", std::move(changes)}};
}

} // namespace tidemark::lsp
