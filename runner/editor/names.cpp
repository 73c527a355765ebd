// The names of a file and what they mean; references, and renaming across the files of a scene.

#include "editor/session.hpp"
#include "editor/workspace.hpp"
#include "scene/host_uniforms.hpp"
#include "shader/builtin_functions.hpp"
#include "shader/vocabulary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <memory>
#include <set>
#include <utility>

namespace tidemark::lsp {
namespace {

using text::Token;
using text::TokenKind;

/// Depth of nested statements up to which scopes are found.
constexpr int k_deepest_statement = 200;
/// Variables of one name in one function that are looked at, so that no text takes long.
constexpr size_t k_most_scopes = 1000;

bool is_qualifier_word(std::string_view word) {
    constexpr std::string_view k_words[] = {"const", "in",      "out",     "inout",     "highp",
                                            "lowp",  "mediump", "precise", "invariant", "uniform",
                                            "flat",  "smooth",  "varying"};
    return std::ranges::find(k_words, word) != std::end(k_words);
}

bool is_name(const Token& token) {
    return token.kind == TokenKind::identifier && !glsl::is_keyword(token.text);
}

} // namespace

FileNames::FileNames(std::string_view text) : reading_(text) {
    read_members();
    for (const glsl::Function& function : reading_.functions)
        read_function(function);
    for (size_t i = 0; i < locals_.size(); ++i)
        by_name_[locals_[i].name].push_back(i);
}

/// Reads the members of structures: `struct Ray { vec3 from, to; float t[2]; };`.
void FileNames::read_members() {
    const auto& code = reading_.preprocessed.code;
    for (size_t at = 0; at + 2 < code.size(); ++at) {
        if (!tokens()[code[at]].is("struct") || !tokens()[code[at + 2]].is("{"))
            continue;
        const std::string_view structure = tokens()[code[at + 1]].text;
        const size_t first = members_.size();
        const size_t close = reading_.closing(code[at + 2], tokens().size());
        for (size_t i = code[at + 2] + 1; i < close;)
            i = declare(i, close, 0, true);
        for (size_t i = first; i < members_.size(); ++i)
            members_[i].structure = structure;
    }
}

/// Reads `float a = 1.0, b[2];` from the token `begin` on, before `end`. Returns the token after it.
size_t FileNames::declare(size_t begin, size_t end, size_t scope_end, bool member) {
    size_t i = begin;
    while (i < end && is_qualifier_word(tokens()[i].text))
        ++i;
    const size_t type = i;
    bool array = false;
    if (i < end && is_name(tokens()[i]))
        ++i;
    if (i > type && i < end && tokens()[i].is("[")) {
        array = true;
        i = reading_.closing(i, end) + 1;
    }
    const bool declares = i > type && i < end && is_name(tokens()[i]);
    bool expects_name = declares;
    size_t from = member ? members_.size() : locals_.size();
    const auto begin_scopes = [&](size_t offset) {
        for (; !member && from < locals_.size(); ++from)
            locals_[from].begin = offset;
    };
    for (; i < end && !tokens()[i].is(";"); ++i) {
        if (expects_name && is_name(tokens()[i])) {
            const bool is_array = array || (i + 1 < end && tokens()[i + 1].is("["));
            if (member)
                members_.push_back({{}, tokens()[i].text, tokens()[type].text, is_array, tokens()[i].begin});
            else if (function_)
                locals_.push_back({tokens()[i].text, tokens()[type].text, false, is_array, tokens()[i].begin,
                                   0, scope_end, tokens()[function_->type_token].begin,
                                   tokens()[function_->body_end].end()});
            expects_name = false;
        } else if (tokens()[i].is("(") || tokens()[i].is("[") || tokens()[i].is("{")) {
            i = std::min(reading_.closing(i, end), end - 1);
        } else if (tokens()[i].is("}")) {
            break;
        } else if (tokens()[i].is(",")) {
            begin_scopes(tokens()[i].begin);
            expects_name = declares;
        }
    }
    begin_scopes(i < tokens().size() ? tokens()[i].begin : scope_end);
    return i + 1;
}

/// Returns the token that ends the statement at `token`: its `;` or `}`.
size_t FileNames::end_of_statement(size_t token, int depth) const {
    const size_t last = function_->body_end;
    if (token >= last || depth > k_deepest_statement)
        return last;
    const Token& first = tokens()[token];
    if (first.is("{"))
        return std::min(reading_.closing(token, last), last);
    if (first.is("do") || first.is("else"))
        return end_of_statement(token + 1, depth + 1);
    if ((first.is("for") || first.is("while") || first.is("if") || first.is("switch")) && token + 1 < last &&
        tokens()[token + 1].is("(")) {
        const size_t end = end_of_statement(reading_.closing(token + 1, last) + 1, depth + 1);
        return first.is("if") && end + 1 < last && tokens()[end + 1].is("else")
                   ? end_of_statement(end + 1, depth + 1)
                   : end;
    }
    for (size_t i = token; i < last; ++i) {
        if (tokens()[i].is(";"))
            return i;
        if (tokens()[i].is("(") || tokens()[i].is("[") || tokens()[i].is("{"))
            i = reading_.closing(i, last);
    }
    return last;
}

void FileNames::read_parameters(const glsl::Function& function) {
    const size_t last = function.defined() ? function.body_end : function.close;
    for (size_t i = function.open + 1; i < function.close; ++i) {
        size_t end = i;
        while (end < function.close && !tokens()[end].is(","))
            end = tokens()[end].is("(") || tokens()[end].is("[") ? reading_.closing(end, function.close) + 1
                                                                 : end + 1;
        end = std::min(end, function.close);
        while (i < end && is_qualifier_word(tokens()[i].text))
            ++i;
        const size_t type = i;
        bool array = false;
        size_t name = type;
        for (size_t at = type + 1; at < end; ++at) {
            array |= tokens()[at].is("[");
            if (is_name(tokens()[at]) && tokens()[at - 1].text != "[" && name == type)
                name = at;
        }
        if (name > type)
            locals_.push_back({tokens()[name].text, tokens()[type].text, true, array, tokens()[name].begin,
                               tokens()[name].begin, tokens()[last].end(),
                               tokens()[function.type_token].begin, tokens()[last].end()});
        i = end;
    }
}

void FileNames::read_function(const glsl::Function& function) {
    if (function.close >= tokens().size() || function.body_end >= tokens().size())
        return;
    read_parameters(function);
    if (!function.defined())
        return;
    function_ = &function;
    std::vector<size_t> ends{function.body_end}; // tokens at which the open scopes end
    bool statement = true;                       // a statement begins here
    for (size_t i = function.body_begin + 1; i < function.body_end;) {
        while (ends.size() > 1 && i > ends.back())
            ends.pop_back();
        const Token& token = tokens()[i];
        const size_t scope_end = tokens()[std::min(ends.back(), function.body_end)].end();
        if (reading_.places[i] != glsl::Place::code || !reading_.active(i)) {
            ++i;
            continue;
        }
        const bool opens = (token.is("for") || token.is("while") || token.is("if") || token.is("switch")) &&
                           i + 1 < function.body_end && tokens()[i + 1].is("(");
        if (token.is("{")) {
            ends.push_back(std::min(reading_.closing(i, function.body_end), function.body_end));
            statement = true;
            ++i;
        } else if (opens) {
            ends.push_back(end_of_statement(i, 0));
            const size_t close = std::min(reading_.closing(i + 1, function.body_end), function.body_end);
            const size_t end = tokens()[ends.back()].end();
            declare(i + 2, close, end, false);
            i = close + 1;
            statement = true;
        } else if (statement && is_name(token)) {
            i = declare(i, function.body_end, scope_end, false);
        } else if (statement && is_qualifier_word(token.text)) {
            i = declare(i, function.body_end, scope_end, false);
        } else {
            statement = token.is(";") || token.is("}") || token.is("else") || token.is("do") || token.is(":");
            ++i;
        }
    }
    function_ = nullptr;
}

const Local* FileNames::local(std::string_view name, size_t offset) const {
    const auto known = by_name_.find(name);
    if (known == by_name_.end())
        return nullptr;
    const std::vector<size_t>& same = known->second; // in text order
    const auto declared =
        std::ranges::lower_bound(same, offset, {}, [&](size_t i) { return locals_[i].name_begin; });
    if (declared != same.end() && locals_[*declared].name_begin == offset)
        return &locals_[*declared];
    // The innermost is the last one before the offset whose scope has not ended.
    auto at = std::ranges::upper_bound(same, offset, {}, [&](size_t i) { return locals_[i].begin; });
    for (size_t tries = 0; at != same.begin() && tries < k_most_scopes; ++tries) {
        const Local& each = locals_[*--at];
        if (offset < each.end)
            return &each;
        if (each.function_end <= offset)
            break; // the others belong to earlier functions
    }
    return nullptr;
}

bool FileNames::is_member(size_t token) const {
    if (token > 0 && tokens()[token - 1].is("."))
        return true;
    const auto after = std::ranges::lower_bound(members_, tokens()[token].begin, {}, &Member::name_begin);
    return after != members_.end() && after->name_begin == tokens()[token].begin;
}

const glsl::MacroLine* FileNames::macro_around(size_t token) const {
    if (reading_.places[token] != glsl::Place::macro_head &&
        reading_.places[token] != glsl::Place::macro_body)
        return nullptr;
    const auto after =
        std::ranges::upper_bound(reading_.preprocessed.macros, token, {}, &glsl::MacroLine::hash);
    return after == reading_.preprocessed.macros.begin() ? nullptr : &*(after - 1);
}

bool FileNames::is_parameter(const glsl::MacroLine& macro, std::string_view name) const {
    for (size_t i = macro.hash + 3; macro.parameters && i < macro.body; ++i)
        if (tokens()[i].is(name))
            return true;
    return false;
}

std::vector<size_t> FileNames::uses(std::string_view name) const {
    std::vector<size_t> found;
    for (size_t i = 0; i < tokens().size(); ++i) {
        if (tokens()[i].kind != TokenKind::identifier || !tokens()[i].is(name) || is_member(i))
            continue;
        const glsl::MacroLine* const macro = macro_around(i);
        if (macro ? !is_parameter(*macro, name) : !local(name, tokens()[i].begin))
            found.push_back(i);
    }
    return found;
}

namespace {

/// The thing that a name in the first file means, with all its uses.
struct Entity {
    enum class Kind { nothing, local, member, macro, knob, global, host };
    Kind kind = Kind::nothing;
    std::string name;
    Local local{};                                              ///< of a local, without views
    size_t begin = 0, end = 0;                                  ///< of the name at the cursor
    std::vector<std::pair<size_t, std::vector<size_t>>> uses{}; ///< tokens, by file
};

/// The names of the workspace's files, read when they are needed.
class Reader {
public:
    explicit Reader(const Workspace& workspace) : workspace_(workspace), names_(workspace.files.size()) {}

    const FileNames& names(size_t file) {
        if (!names_[file])
            names_[file] = std::make_unique<FileNames>(workspace_.files[file].text);
        return *names_[file];
    }

    bool declares(size_t file, std::string_view name, Symbol::Kind kind) const {
        return std::ranges::any_of(workspace_.files[file].symbols, [&](const Symbol& symbol) {
            return symbol.name == name && symbol.kind == kind;
        });
    }

    Entity entity_at(size_t offset) {
        Entity entity;
        const FileNames& own = names(0);
        const auto word = word_at(own.tokens(), offset);
        if (!word || glsl::is_keyword(word->text))
            return entity;
        const auto token = size_t(std::ranges::lower_bound(own.tokens(), word->begin, {}, &Token::begin) -
                                  own.tokens().begin());
        entity.name = word->text;
        entity.begin = word->begin;
        entity.end = word->end();
        const auto beside = workspace_.files_beside(0);
        const auto is = [&](Symbol::Kind kind) {
            return std::ranges::any_of(beside,
                                       [&](size_t file) { return declares(file, entity.name, kind); });
        };
        const glsl::MacroLine* const macro = own.macro_around(token);
        if (own.is_member(token)) {
            entity.kind = Entity::Kind::member;
            add_members(entity, beside);
        } else if (const Local* local = macro ? nullptr : own.local(word->text, word->begin)) {
            entity.kind = Entity::Kind::local;
            entity.local = *local;
            for (size_t i = 0; i < own.tokens().size(); ++i)
                if (own.tokens()[i].is(entity.name) && !own.is_member(i) && !own.macro_around(i) &&
                    own.local(entity.name, own.tokens()[i].begin) == local)
                    add(entity, 0, i);
        } else if (macro && own.is_parameter(*macro, word->text)) {
            return {};
        } else if (scene::is_host_uniform(entity.name)) {
            entity.kind = Entity::Kind::host;
            add_uses(entity, beside);
        } else if (is(Symbol::Kind::macro)) {
            entity.kind = Entity::Kind::macro;
            add_uses(entity, beside);
        } else if (workspace_.knob(entity.name)) {
            entity.kind = Entity::Kind::knob;
            std::vector<size_t> all(workspace_.files.size());
            for (size_t i = 0; i < all.size(); ++i)
                all[i] = i;
            add_uses(entity, all);
        } else if (is(Symbol::Kind::function) || is(Symbol::Kind::variable) || is(Symbol::Kind::constant) ||
                   is(Symbol::Kind::structure)) {
            entity.kind = Entity::Kind::global;
            add_uses(entity, files_that_share(entity.name));
        } else if (glsl::find_builtin(entity.name)) {
            entity.kind = Entity::Kind::host;
            add_uses(entity, beside);
        }
        return entity;
    }

private:
    static void add(Entity& entity, size_t file, size_t token) {
        if (entity.uses.empty() || entity.uses.back().first != file)
            entity.uses.push_back({file, {}});
        entity.uses.back().second.push_back(token);
    }

    void add_uses(Entity& entity, const std::vector<size_t>& files) {
        for (const size_t file : files)
            for (const size_t token : names(file).uses(entity.name))
                add(entity, file, token);
    }

    void add_members(Entity& entity, const std::vector<size_t>& files) {
        for (const size_t file : files)
            for (size_t i = 0; i < names(file).tokens().size(); ++i)
                if (names(file).tokens()[i].is(entity.name) && names(file).is_member(i))
                    add(entity, file, i);
    }

    /// Returns the files of all passes that share a use of the name, from the first file on: a pass whose
    /// text uses another declaration of that name is not among them.
    std::vector<size_t> files_that_share(const std::string& name) {
        std::set<size_t> files{0};
        for (std::deque<size_t> next{0}; !next.empty(); next.pop_front()) {
            if (next.front() != 0 && names(next.front()).uses(name).empty())
                continue;
            for (const size_t file : workspace_.files_beside(next.front()))
                if (files.insert(file).second)
                    next.push_back(file);
        }
        return {files.begin(), files.end()};
    }

    const Workspace& workspace_;
    std::vector<std::unique_ptr<FileNames>> names_;
};

constexpr std::string_view k_called_by_host[] = {"main",        "mainImage", "mainSound",
                                                 "mainCubemap", "mainHit",   "mainVR"};

bool is_valid_name(std::string_view name) {
    const auto tokens = text::tokenize(name);
    return tokens.size() == 1 && tokens.front().kind == TokenKind::identifier &&
           tokens.front().text.size() == name.size();
}

bool is_reserved(const std::string& name) {
    return name.starts_with("gl_") || name.find("__") != name.npos || glsl::find_builtin(name) ||
           glsl::is_keyword(name) || glsl::is_one_of(name, glsl::k_reserved_words) ||
           glsl::value_type(name) || scene::is_host_uniform(name) || name.starts_with("tidemark_") ||
           glsl::is_one_of(name, k_called_by_host);
}

/// Returns the reason why the thing cannot be renamed at all; empty: it can.
std::string why_fixed(const Entity& entity, const Workspace& workspace, Reader& reader) {
    using Kind = Entity::Kind;
    switch (entity.kind) {
    case Kind::nothing: return "there is no name of the scene here";
    case Kind::member:
        return fmt::format("'{}' is a member: only whole variables can be renamed", entity.name);
    case Kind::macro:
        return fmt::format("'{}' is a macro: its text may join names or stand in an #if, so a rename could "
                           "change what is compiled",
                           entity.name);
    case Kind::host: return fmt::format("'{}' is given by GLSL or the host", entity.name);
    default: break;
    }
    if (glsl::is_one_of(entity.name, k_called_by_host))
        return fmt::format("the host calls '{}' by its name", entity.name);
    if (workspace.passes.empty() && entity.kind == Kind::global && workspace.knows_scene)
        return "the scene does not load: fix its errors first";
    const auto affected = entity.kind == Kind::local ? workspace.files_beside(0) : [&] {
        std::vector<size_t> files;
        for (const auto& [file, tokens] : entity.uses)
            files.push_back(file);
        return files;
    }();
    const bool also_local = entity.kind != Kind::local && std::ranges::any_of(affected, [&](size_t file) {
                                const auto& locals = reader.names(file).locals();
                                return std::ranges::find(locals, entity.name, &Local::name) != locals.end();
                            });
    for (const size_t file : affected) {
        const FileNames& names = reader.names(file);
        if (entity.kind != Kind::local && workspace.is_library(workspace.files[file].path))
            return fmt::format("'{}' belongs to the shader library", entity.name);
        for (size_t i = 0; i + 1 < names.tokens().size(); ++i) {
            const glsl::MacroLine* const macro = names.macro_around(i);
            if (!macro)
                continue;
            if (names.tokens()[i].is("#") && names.tokens()[i + 1].is("#") && names.tokens()[i + 1].glued)
                return fmt::format("the macro '{}' joins names with ##", macro->name);
            if (entity.kind == Kind::local && names.tokens()[i].is(entity.name) &&
                !names.is_parameter(*macro, entity.name) && macro->name != entity.name)
                return fmt::format("the macro '{}' uses the name '{}'", macro->name, entity.name);
            if (also_local && names.tokens()[i].is(entity.name))
                return fmt::format("the macro '{}' uses the name '{}', which is also a local variable",
                                   macro->name, entity.name);
        }
    }
    return {};
}

/// Returns the reason why the thing cannot have that name; empty: it can.
std::string why_not(const Entity& entity, const std::string& name, const Workspace& workspace,
                    Reader& reader) {
    if (!is_valid_name(name))
        return "it is not a GLSL name";
    if (is_reserved(name))
        return "the name is reserved by GLSL or the host";
    const bool local = entity.kind == Entity::Kind::local;
    for (size_t file = 0; file < workspace.files.size(); ++file) {
        const FileNames& names = reader.names(file);
        for (size_t i = 0; i < names.tokens().size(); ++i) {
            const Token& token = names.tokens()[i];
            if (token.kind != TokenKind::identifier || !token.is(name) || names.is_member(i))
                continue;
            const bool in_function = file == 0 && token.begin >= entity.local.function_begin &&
                                     token.begin < entity.local.function_end;
            if (!local || in_function || names.macro_around(i))
                return fmt::format("'{}' has that name already",
                                   workspace.files[file].path.filename().string());
        }
    }
    return {};
}

Json location(const Question& asked, const SourceFile& file, const Lines& lines, const Token& token) {
    return {{"uri", asked.documents.uri_of(file.path)}, {"range", lines.range(token.begin, token.end())}};
}

} // namespace

/// Returns the Locations of all uses in the scene.
Answer references(const Question& asked) {
    Reader reader(asked.workspace);
    const Entity entity = reader.entity_at(asked.offset());
    const bool declaration = asked.params.value("/context/includeDeclaration"_json_pointer, true) ||
                             entity.kind == Entity::Kind::host;
    Json found = Json::array();
    for (const auto& [file, tokens] : entity.uses) {
        const SourceFile& source = asked.workspace.files[file];
        const Lines lines(source.text, asked.encoding);
        std::set<size_t> declared{entity.local.name_begin};
        if (entity.kind != Entity::Kind::local)
            declared.clear();
        for (const Symbol& symbol : source.symbols)
            if (symbol.name == entity.name)
                declared.insert(symbol.name_begin);
        for (const size_t i : tokens) {
            const Token& token = reader.names(file).tokens()[i];
            const bool declares = declared.contains(token.begin);
            if (declaration || !declares)
                found.push_back(location(asked, source, lines, token));
        }
    }
    return found;
}

/// Returns the DocumentHighlights: the uses in the first file.
Answer highlights(const Question& asked) {
    Reader reader(asked.workspace);
    const Lines lines(asked.workspace.files.front().text, asked.encoding);
    Json found = Json::array();
    for (const auto& [file, tokens] : reader.entity_at(asked.offset()).uses)
        for (const size_t i : tokens)
            if (file == 0)
                found.push_back({{"range", lines.range(reader.names(0).tokens()[i].begin,
                                                       reader.names(0).tokens()[i].end())}});
    return found;
}

/// Returns the range of the name at an offset; null without a name of the scene there. Fails with the reason
/// where it cannot be renamed.
Answer renamed_range(const Question& asked) {
    Reader reader(asked.workspace);
    const Entity entity = reader.entity_at(asked.offset());
    if (entity.kind == Entity::Kind::nothing)
        return Json();
    if (const std::string why = why_fixed(entity, asked.workspace, reader); !why.empty())
        return refuse(ErrorNumber::request_failed, why);
    return Lines(asked.workspace.files.front().text, asked.encoding).range(entity.begin, entity.end);
}

/// Returns a WorkspaceEdit. Fails where the thing cannot be renamed, or where the new name is not valid or is
/// used already.
Answer rename(const Question& asked) {
    const auto name = asked.params.at("newName").get<std::string>();
    Reader reader(asked.workspace);
    const Entity entity = reader.entity_at(asked.offset());
    if (const std::string why = why_fixed(entity, asked.workspace, reader); !why.empty())
        return refuse(ErrorNumber::request_failed, why);
    if (const std::string why = why_not(entity, name, asked.workspace, reader); !why.empty())
        return refuse(ErrorNumber::request_failed,
                      fmt::format("'{}' cannot be called '{}': {}", entity.name, name, why));
    Json changes = Json::object();
    for (const auto& [file, tokens] : entity.uses) {
        const SourceFile& source = asked.workspace.files[file];
        const Lines lines(source.text, asked.encoding);
        for (const size_t i : tokens) {
            const Token& token = reader.names(file).tokens()[i];
            changes[asked.documents.uri_of(source.path)].push_back(
                {{"range", lines.range(token.begin, token.end())}, {"newText", name}});
        }
    }
    return Json{{"changes", std::move(changes)}};
}

} // namespace tidemark::lsp
