#include "editor/workspace.hpp"

#include "base/encoding.hpp"
#include "base/folders.hpp"
#include "base/mapped_text.hpp"
#include "scene/load_scene.hpp"
#include "scene/names.hpp"
#include "shader/token_reading.hpp"
#include "shader/vocabulary.hpp"

#include <algorithm>
#include <initializer_list>
#include <map>

namespace tidemark::lsp {
namespace fs = std::filesystem;
namespace {

/// Returns the line without its comment marks: `//`, `/**`, `*`, `///<` and the like.
std::string_view without_marks(std::string_view line) {
    line = trimmed(line);
    if (line.ends_with("*/"))
        line.remove_suffix(2);
    line.remove_prefix(std::min(line.find_first_not_of("/*!<"), line.size()));
    return trimmed(line);
}

bool is_line_comment(std::string_view line) {
    return trimmed(line).starts_with("//");
}

template <class Range>
std::string joined(const Range& lines) {
    std::string comment;
    for (const std::string_view line : lines)
        if (const auto words = without_marks(line); !words.empty())
            comment += (comment.empty() ? "" : "\n") + std::string(words);
    return comment;
}

using glsl::Reading;
using text::Token;
using text::TokenKind;
using Kind = Symbol::Kind;

constexpr std::string_view k_knob = "iUniform";

/// Joins tokens, with one blank for each run of blanks, line ends and comments.
std::string on_one_line(const std::vector<Token>& tokens, size_t begin, size_t end) {
    std::string line;
    for (size_t i = begin; i < end; ++i) {
        if (i > begin && !tokens[i].glued)
            line += ' ';
        line += tokens[i].text;
    }
    return line;
}

class Outliner {
public:
    explicit Outliner(std::string_view text) : text_(text), reading_(text) {}

    std::vector<Symbol> run() {
        for (const glsl::Function& function : reading_.functions)
            if (function.defined())
                add_function(function);
        for (const glsl::MacroLine& macro : reading_.preprocessed.macros)
            if (!macro.undefines)
                add(Kind::macro, macro.hash, macro.hash + 2, macro.end, macro.end);
        for (const size_t hash : reading_.preprocessed.directives)
            add_knob(hash);
        add_globals();
        std::ranges::sort(symbols_, {}, &Symbol::begin);
        return std::move(symbols_);
    }

private:
    const std::vector<Token>& tokens() const { return reading_.tokens; }

    /// Adds a symbol for the tokens [first, last); those before `shown` are its signature.
    void add(Kind kind, size_t first, size_t name, size_t shown, size_t last) {
        if (name >= tokens().size() || last <= first || last > tokens().size())
            return;
        symbols_.push_back({kind, std::string(tokens()[name].text), on_one_line(tokens(), first, shown),
                            comment_above(text_, tokens()[first].begin), tokens()[first].begin,
                            tokens()[last - 1].end(), tokens()[name].begin});
    }

    void add_function(const glsl::Function& function) {
        add(Kind::function, function.type_token, function.name_token, function.close + 1,
            function.body_end + 1);
    }

    /// Adds a knob's line: `#iUniform float speed = 1.0 in { 0.0, 2.0 }`.
    void add_knob(size_t hash) {
        const size_t end = text::end_of_directive(tokens(), hash);
        if (hash + 3 < end && tokens()[hash + 1].is(k_knob))
            add(Kind::knob, hash, hash + 3, end, end);
    }

    /// Adds the declarations between semicolons outside of braces and functions.
    void add_globals() {
        size_t first = 0;
        bool begun = false;
        const std::vector<size_t>& code = reading_.preprocessed.code;
        for (size_t at = 0; at < code.size(); ++at) {
            const size_t i = code[at];
            if (!begun) {
                first = i;
                begun = true;
            }
            if (const glsl::Function* function = glsl::function_around(reading_.functions, i)) {
                while (at + 1 < code.size() && code[at + 1] <= function->body_end)
                    ++at;
                begun = false;
            } else if (tokens()[i].is("{") || tokens()[i].is("(")) {
                const size_t close = reading_.closing(i, tokens().size());
                while (at + 1 < code.size() && code[at + 1] <= close)
                    ++at;
            } else if (tokens()[i].is(";")) {
                add_declaration(first, i);
                begun = false;
            }
        }
    }

    /// Adds the names declared by the tokens [first, end): `const float a = 1.0, b[2];`, `struct Ray { … }
    /// ray;`.
    void add_declaration(size_t first, size_t end) {
        size_t at = first;
        bool constant = false;
        while (at < end && is_qualifier(tokens()[at].text))
            constant |= tokens()[at++].is("const");
        if (at + 1 >= end || tokens()[at].kind != TokenKind::identifier || tokens()[at].is("precision"))
            return;
        if (tokens()[at].is("struct")) {
            add(Kind::structure, first, at + 1, at + 2, end);
            return;
        }
        // The names follow the type, separated by commas outside of brackets.
        bool expects_name = true;
        for (size_t i = at + 1; i < end; ++i) {
            if (tokens()[i].is("(") || tokens()[i].is("[") || tokens()[i].is("{")) {
                if (expects_name && tokens()[i].is("("))
                    return; // a function prototype
                i = reading_.closing(i, end);
            } else if (tokens()[i].is(",")) {
                expects_name = true;
            } else if (expects_name && tokens()[i].kind == TokenKind::identifier) {
                if (i + 1 < end && tokens()[i + 1].is("("))
                    return;
                add(constant ? Kind::constant : Kind::variable, first, i, end, end);
                expects_name = false;
            }
        }
    }

    static bool is_qualifier(std::string_view word) {
        constexpr std::string_view k_words[] = {"const", "uniform", "in",   "out",     "flat",
                                                "highp", "mediump", "lowp", "precise", "invariant"};
        return std::ranges::find(k_words, word) != std::end(k_words);
    }

    std::string_view text_;
    Reading reading_;
    std::vector<Symbol> symbols_;
};

/// Files in one folder that are searched for a scene that includes a file.
constexpr size_t k_most_neighbours = 100;

bool is_folder_scene(const fs::path& folder, const fs::path& file) {
    const auto files = scene::pass_files(folder);
    return files &&
           std::ranges::any_of(
               *files, [](const auto& pass) { return pass.first.kind == scene::PassName::Kind::image; }) &&
           std::ranges::any_of(*files, [&](const auto& pass) { return canonical_name(pass.second) == file; });
}

bool names_one_of(const std::vector<text::Token>& tokens, std::initializer_list<std::string_view> names) {
    return std::ranges::any_of(tokens, [&](const text::Token& token) {
        return std::ranges::any_of(names, [&](std::string_view name) { return token.is(name); });
    });
}

/// Returns whether the file has a ShaderToy entry point, or a `main` without names that belong to other
/// shader stages.
bool has_entry_point(const fs::path& file, const Documents& documents) {
    const auto text = documents.text_of(file);
    if (!text)
        return false;
    const std::vector<text::Token> tokens = text::tokenize(*text);
    return names_one_of(tokens, {"mainImage", "mainCubemap", "mainSound"}) ||
           (names_one_of(tokens, {"main"}) &&
            !names_one_of(tokens,
                          {"gl_Position", "gl_TessLevelOuter", "gl_GlobalInvocationID", "local_size_x"}));
}

bool reads(const fs::path& scene, const fs::path& file, const Documents& documents) {
    const auto loaded = scene::load_scene(scene, {.media = {}, .unsaved = documents.texts()});
    return loaded && std::ranges::any_of(loaded->files,
                                         [&](const fs::path& each) { return canonical_name(each) == file; });
}

bool is_project(const fs::path& file, const Documents& documents) {
    if (file.extension() != ".json")
        return false;
    const auto text = documents.text_of(file);
    return text && text->find("\"renderpass\"") != text->npos;
}

/// Returns the scene that the file itself belongs to, without looking for files that include it.
std::optional<fs::path> own_scene(const fs::path& file, const Documents& documents) {
    if (is_folder_scene(file.parent_path(), file))
        return file.parent_path();
    if (is_project(file, documents) || has_entry_point(file, documents))
        return file;
    return std::nullopt;
}

std::optional<fs::path> scene_that_includes(const fs::path& folder, const fs::path& file,
                                            const Documents& documents) {
    std::error_code error;
    size_t seen = 0;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        if (!scene::is_shader_file(entry->path()) || ++seen > k_most_neighbours)
            continue;
        auto scene = own_scene(canonical_name(entry->path()), documents);
        if (scene && reads(*scene, file, documents))
            return scene;
    }
    return std::nullopt;
}

void add_file(Workspace& workspace, const fs::path& path, const Documents& documents) {
    const fs::path file = canonical_name(path);
    if (std::ranges::find(workspace.files, file, &SourceFile::path) != workspace.files.end())
        return;
    auto text = documents.text_of(file);
    if (!text)
        return;
    std::vector<Symbol> symbols = outline(*text);
    workspace.files.push_back({file, *std::move(text), std::move(symbols)});
}

bool lies_in(const fs::path& file, const fs::path& folder) {
    const fs::path inside = file.lexically_relative(canonical_name(folder));
    return !folder.empty() && !inside.empty() && *inside.begin() != "..";
}

} // namespace

std::string comment_above(std::string_view text, size_t offset) {
    size_t begin = offset == 0 ? 0 : text.rfind('\n', offset - 1) + 1;
    std::vector<std::string_view> lines; // from bottom to top, only as far as the comment reaches
    const auto take_line = [&] {
        const size_t end = begin - 1;
        begin = end == 0 ? 0 : text.rfind('\n', end - 1) + 1;
        lines.push_back(text.substr(begin, end - begin));
        return lines.back();
    };
    if (begin == 0)
        return {};
    if (trimmed(take_line()).ends_with("*/")) {
        while (begin > 0 && lines.back().find("/*") == lines.back().npos)
            take_line();
        if (!trimmed(lines.back()).starts_with("/*")) // a comment after code
            return {};
    } else {
        while (is_line_comment(lines.back()) && begin > 0)
            take_line();
        if (!is_line_comment(lines.back()))
            lines.pop_back();
    }
    std::ranges::reverse(lines);
    return joined(lines);
}

std::string leading_comment(std::string_view text) {
    const auto lines = text::lines_of(text);
    if (lines.empty())
        return {};
    auto end = lines.begin();
    if (trimmed(lines.front()).starts_with("/*"))
        end =
            std::min(std::ranges::find_if(lines, [](auto line) { return line.find("*/") != line.npos; }) + 1,
                     lines.end());
    else
        end = std::ranges::find_if_not(lines, is_line_comment);
    return joined(std::vector(lines.begin(), end));
}

bool ends_in_comment(std::string_view text) {
    bool line = false, block = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const std::string_view two = text.substr(i, 2);
        if (line)
            line = text[i] != '\n';
        else if (block && two == "*/")
            block = false, ++i;
        else if (!block && two == "//")
            line = true;
        else if (!block && two == "/*")
            block = true, ++i;
    }
    return line || block;
}

std::string with_closed_brackets(const std::string& text, std::string_view before) {
    const auto open_in = [](std::string_view part) {
        std::string open;
        for (const Token& token : text::tokenize(part)) {
            const int nesting = glsl::nesting(token.text);
            if (nesting > 0)
                open += token.text;
            else if (nesting < 0 && !open.empty())
                open.pop_back();
        }
        return open;
    };
    if (open_in(text).empty())
        return text;
    std::string result(before);
    const std::string open = open_in(before);
    for (auto bracket = open.rbegin(); bracket != open.rend(); ++bracket)
        result += *bracket == '(' ? ")" : *bracket == '[' ? "]" : ";}";
    return result;
}

std::vector<Symbol> outline(std::string_view text) {
    return Outliner(text).run();
}

std::optional<fs::path> scene_of(const fs::path& path, const Documents& documents) {
    const fs::path file = canonical_name(path);
    if (auto scene = own_scene(file, documents))
        return scene;
    for (const fs::path& folder : {file.parent_path(), file.parent_path().parent_path()})
        if (auto scene = scene_that_includes(folder, file, documents))
            return scene;
    return std::nullopt;
}

const scene::Knob* Workspace::knob(std::string_view name) const {
    const auto found = std::ranges::find(knobs, name, &scene::Knob::name);
    return found == knobs.end() ? nullptr : &*found;
}

Workspace look_around(const fs::path& file, const std::optional<fs::path>& scene,
                      const Documents& documents) {
    Workspace workspace{.files = {}, .knobs = {}, .library = library_folder()};
    add_file(workspace, file, documents);
    if (!scene)
        return workspace;
    workspace.knows_scene = true;
    auto loaded = scene::load_scene(*scene, {.media = {}, .unsaved = documents.texts()});
    if (!loaded)
        return workspace;
    for (const fs::path& each : loaded->files)
        if (scene::is_shader_file(each))
            add_file(workspace, each, documents);
    workspace.knobs = std::move(loaded->knobs);
    std::map<std::string, std::optional<size_t>> index_of;
    const auto add_files = [&](const text::MappedText& text, std::set<size_t>& files) {
        for (int line = 1; line <= text.line_count(); ++line) {
            const std::string name = text.lines().locate(line).file;
            const auto [known, is_new] = index_of.try_emplace(name);
            if (is_new && !name.empty()) {
                const auto found =
                    std::ranges::find(workspace.files, canonical_name(name), &SourceFile::path);
                if (found != workspace.files.end())
                    known->second = size_t(found - workspace.files.begin());
            }
            if (known->second)
                files.insert(*known->second);
        }
    };
    std::set<size_t> common;
    add_files(loaded->common, common);
    for (const scene::Pass& pass : loaded->passes) {
        std::set<size_t> files = common;
        add_files(pass.text, files);
        workspace.passes.emplace_back(files.begin(), files.end());
    }
    return workspace;
}

std::vector<size_t> Workspace::files_beside(size_t file) const {
    std::set<size_t> beside{file};
    for (const std::vector<size_t>& pass : passes)
        if (std::ranges::find(pass, file) != pass.end())
            beside.insert(pass.begin(), pass.end());
    return {beside.begin(), beside.end()};
}

bool Workspace::is_library(const fs::path& file) const {
    return lies_in(canonical_name(file), library);
}

bool Workspace::may_read(const fs::path& file) const {
    const fs::path wanted = canonical_name(file);
    return std::ranges::find(files, wanted, &SourceFile::path) != files.end() || lies_in(wanted, library) ||
           lies_in(wanted, files.front().path.parent_path());
}

std::set<fs::path> files_of(const fs::path& scene, const Documents& documents) {
    std::set<fs::path> files;
    if (const auto loaded = scene::load_scene(scene, {.media = {}, .unsaved = documents.texts()}))
        for (const fs::path& each : loaded->files)
            files.insert(canonical_name(each));
    return files;
}

std::optional<text::Token> word_at(const std::vector<text::Token>& tokens, size_t offset) {
    for (const text::Token& token : tokens)
        if (token.kind == text::TokenKind::identifier && token.begin <= offset && offset <= token.end())
            return token;
    return std::nullopt;
}

fs::path included_at(const Workspace& workspace, size_t offset) {
    const SourceFile& file = workspace.files.front();
    for (const text::Include& include : text::find_includes(file.text))
        if (include.begin <= offset && offset <= include.end)
            return ((include.of_library ? workspace.library : file.path.parent_path()) / include.name)
                .lexically_normal();
    return {};
}

} // namespace tidemark::lsp
