#include "lsp/scene_of.hpp"

#include "scene/folder_scene.hpp"
#include "scene/load_scene.hpp"
#include "text/tokens.hpp"

#include <algorithm>
#include <initializer_list>
#include <string_view>
#include <vector>

namespace tidemark::lsp {
namespace fs = std::filesystem;
namespace {

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

} // namespace

std::optional<fs::path> scene_of(const fs::path& path, const Documents& documents) {
    const fs::path file = canonical_name(path);
    if (auto scene = own_scene(file, documents))
        return scene;
    for (const fs::path& folder : {file.parent_path(), file.parent_path().parent_path()})
        if (auto scene = scene_that_includes(folder, file, documents))
            return scene;
    return std::nullopt;
}

} // namespace tidemark::lsp
