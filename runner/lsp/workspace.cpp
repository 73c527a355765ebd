#include "lsp/workspace.hpp"

#include "base/installed.hpp"
#include "scene/load_scene.hpp"
#include "scene/pass_names.hpp"
#include "text/includes.hpp"

#include <algorithm>

namespace tidemark::lsp {
namespace fs = std::filesystem;
namespace {

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

} // namespace

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
    auto loaded = scene::load_scene(*scene, {.media = {}, .unsaved = documents.texts()});
    if (!loaded)
        return workspace;
    for (const fs::path& each : loaded->files)
        if (scene::is_shader_file(each))
            add_file(workspace, each, documents);
    workspace.knobs = std::move(loaded->knobs);
    return workspace;
}

bool Workspace::may_read(const fs::path& file) const {
    const fs::path wanted = canonical_name(file);
    const auto lies_in = [&](const fs::path& folder) {
        const fs::path inside = wanted.lexically_relative(canonical_name(folder));
        return !folder.empty() && !inside.empty() && *inside.begin() != "..";
    };
    return std::ranges::find(files, wanted, &SourceFile::path) != files.end() || lies_in(library) ||
           lies_in(files.front().path.parent_path());
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
