#include "scene/folder_scene.hpp"

#include "base/file.hpp"
#include "base/try.hpp"
#include "scene/bounds.hpp"
#include "scene/media.hpp"
#include "scene/pass_loader.hpp"
#include "scene/project.hpp"
#include "scene/project_drafts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

namespace tidemark::scene {
namespace fs = std::filesystem;
namespace {

using Kind = ProjectPass::Kind;
using PassFiles = std::vector<std::pair<PassName, fs::path>>;

Scene scene_of(const fs::path& folder) {
    Scene scene;
    scene.file = folder;
    return scene;
}

bool is_read_by_another(const Scene& scene, size_t pass) {
    for (size_t reader = 0; reader < scene.passes.size(); ++reader)
        for (const Channel& channel : scene.passes[reader].channels)
            if (reader != pass && channel.input == ChannelInput(PassOutput{pass}))
                return true;
    return false;
}

/// Warns of a buffer or cube that no other pass reads. Passes found by file name read nothing unless a
/// directive says so; without one the channel is noise.
void warn_of_unread(Scene& scene, const PassFiles& files) {
    for (size_t pass = 0; pass < scene.passes.size(); ++pass)
        for (const auto& [name, file] : files)
            if ((name.kind == Kind::buffer || name.kind == Kind::cubemap) &&
                scene.passes[pass].name == to_string(name) && !is_read_by_another(scene, pass))
                scene.warnings.push_back(
                    {{file.string()},
                     Severity::warning,
                     fmt::format("no other pass reads '{}': the one that does says #iChannel0 \"{}\"",
                                 scene.passes[pass].name, file.filename().string())});
}

Result<Scene> load_by_names(const fs::path& folder, const PassFiles& files, const LoadOptions& options) {
    if (std::none_of(files.begin(), files.end(),
                     [](const auto& file) { return file.first.kind == Kind::image; }))
        return fail(ErrorCode::load,
                    fmt::format("'{}' has no image.glsl: a scene folder holds image.glsl and, as needed, "
                                "buffer_a.glsl to buffer_d.glsl, common.glsl, cube_a.glsl and sound.glsl",
                                folder.string()));
    Scene scene = scene_of(folder);
    const Bounds bounds(folder, options.allow_outside, &options.unsaved);
    PassLoader loader(scene, folder, bounds);
    std::vector<size_t> drafts;
    for (const auto& [name, file] : files) {
        if (name.kind == Kind::common) {
            TRY(loader.load_common(file));
            continue;
        }
        Draft draft;
        draft.pass.kind = kind_of(name.kind);
        draft.pass.name = to_string(name);
        draft.file = file;
        drafts.push_back(loader.add(std::move(draft)));
    }
    for (const size_t draft : drafts)
        TRY(loader.load(draft));
    TRY(loader.finish());
    warn_of_unread(scene, files);
    return scene;
}

/// Warns of a file that is named like a pass but unused: its author expects to see it.
void warn_of_unused(Scene& scene, const PassFiles& files, const fs::path& project) {
    for (const auto& [name, file] : files)
        if (std::find(scene.files.begin(), scene.files.end(), file) == scene.files.end())
            scene.warnings.push_back({{file.string()},
                                      Severity::warning,
                                      fmt::format("'{}' has no pass with this file: it is not drawn",
                                                  project.filename().string())});
}

Result<Scene> load_by_project(const fs::path& folder, const PassFiles& files, const LoadOptions& options) {
    const fs::path file = folder / k_project_file;
    const Bounds bounds(folder, options.allow_outside, &options.unsaved);
    const auto json = bounds.check(file).and_then([&] { return read_file(file); });
    if (!json)
        return fail(json.error());
    auto project = TRY(read_project(*json, file.string(), CodeIn::files));
    const std::vector<std::string> names = pass_names(project);
    Scene scene = scene_of(folder);
    scene.files.push_back(file);
    const MediaFolder media(options.media);
    auto drafts = TRY(draft_project(scene, {project, names, folder, media, bounds, file.string()}));

    PassLoader loader(scene, folder, bounds, Conditional::leave);
    for (size_t i = 0; i < names.size(); ++i) {
        ProjectPass& pass = project.passes[i];
        const std::string place = fmt::format("{}:{}", file.string(), names[i]);
        const fs::path code = pass.file ? (folder / *pass.file).lexically_normal() : fs::path();
        if (!drafts.of_pass[i]) {
            if (pass.file)
                TRY(loader.load_common(code));
            else
                scene.common.append(plain_text(std::move(pass.code)), place, 1);
            continue;
        }
        Draft& draft = drafts.drafts[*drafts.of_pass[i]];
        draft.file = code;
        if (!pass.file)
            draft.pass.text.append(plain_text(std::move(pass.code)), place, 1);
    }
    for (Draft& draft : drafts.drafts)
        loader.add(std::move(draft));
    for (const size_t draft : drafts.order)
        TRY(loader.load(draft));
    TRY(loader.finish());
    warn_of_unused(scene, files, file);
    return scene;
}

} // namespace

std::vector<fs::path> scene_files_in(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const fs::path& file = entry->path();
        if (file.filename() == k_project_file ||
            (is_shader_file(file) && parse_pass_name(file.stem().string())))
            files.push_back(file);
    }
    std::ranges::sort(files);
    return files;
}

Result<PassFiles> pass_files(const fs::path& folder) {
    PassFiles files;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const fs::path file = (folder / entry->path().filename()).lexically_normal();
        const auto name = parse_pass_name(file.stem().string());
        std::error_code ignored;
        if (name && is_shader_file(file) && !fs::is_directory(file, ignored))
            files.emplace_back(*name, file);
    }
    if (error)
        return fail(ErrorCode::load,
                    fmt::format("cannot read the folder '{}': {}", folder.string(), error.message()));
    const auto rank = [](const auto& file) {
        return std::tuple(file.first.kind, file.first.number, file.second);
    };
    std::sort(files.begin(), files.end(), [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
    for (size_t i = 1; i < files.size(); ++i)
        if (files[i].first == files[i - 1].first)
            return fail(ErrorCode::load, fmt::format("'{}' and '{}' are both the pass '{}': rename one",
                                                     files[i - 1].second.string(), files[i].second.string(),
                                                     to_string(files[i].first)));
    return files;
}

Result<Scene> load_folder_scene(const fs::path& folder, const LoadOptions& options) {
    const auto files = TRY(pass_files(folder));
    std::error_code ignored;
    return fs::exists(folder / k_project_file, ignored) ? load_by_project(folder, files, options)
                                                        : load_by_names(folder, files, options);
}

} // namespace tidemark::scene
