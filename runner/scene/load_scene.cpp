// Loads ShaderToy's JSON as a Scene.

#include "scene/load_scene.hpp"

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/folders.hpp"
#include "scene/names.hpp"
#include "scene/pass_loader.hpp"
#include "scene/project.hpp"
#include "scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <tuple>

namespace tidemark::scene {

/// Reads a project in one `.json`. Messages give its lines as `x.json:Buffer A`, with line 1 the first line
/// of the pass. The texts are ShaderToy's: directives and includes in them are left to the driver.
Result<Scene> load_json_scene(const std::filesystem::path& path, const LoadOptions& options);

namespace fs = std::filesystem;
namespace {

bool is_inside(const fs::path& file, const fs::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

/// Returns an empty path if the folder does not exist.
fs::path real_path(const fs::path& path) {
    std::error_code error;
    fs::path real = fs::canonical(path, error);
    return error ? fs::path() : real;
}

} // namespace

Bounds::Bounds(const fs::path& folder, bool allow_outside, const UnsavedTexts* unsaved)
    : folder_(folder.empty() ? "." : folder.string()), everything_(allow_outside), unsaved_(unsaved),
      library_(library_folder()) {
    if (const fs::path library = real_path(library_); !library.empty())
        roots_.push_back(library);
    const fs::path root = real_path(folder.empty() ? fs::path(".") : folder);
    if (root.empty())
        return;
    roots_.push_back(root);
    for (const char* name : {"textures", "lib"}) {
        // A link of that name could lead anywhere, so only a real folder at that place counts.
        const fs::path beside = root.parent_path() / name;
        if (real_path(beside) == beside)
            roots_.push_back(beside);
    }
}

Result<void> Bounds::check(const fs::path& file) const {
    const auto cannot_read = [&](std::string_view why) {
        return fail(ErrorCode::load, fmt::format("cannot read '{}': {}", file.string(), why));
    };
    if (is_inside(file, library_))
        if (const std::string why = why_no_library(); !why.empty())
            return cannot_read(why);
    if (everything_)
        return {};
    if (file.native().find('\0') != std::string::npos) // the system would read the name only up to there
        return cannot_read(why_unreadable(file));
    std::error_code error;
    fs::path real = fs::absolute(file, error);
    if (!error)
        real = fs::weakly_canonical(real, error);
    if (error)
        return cannot_read(error.message());
    if (std::any_of(roots_.begin(), roots_.end(),
                    [&](const fs::path& root) { return is_inside(real, root); }))
        return {};
    return fail(
        ErrorCode::load,
        fmt::format("'{}' lies outside the scene's folder '{}': move it there, into a folder 'textures' "
                    "or 'lib' beside it, or give --allow-outside",
                    file.string(), folder_));
}

Result<std::string> Bounds::read_text(const fs::path& file) const {
    return check(file).and_then([&] { return read_text_file(file); });
}

const std::string* Bounds::unsaved(const fs::path& file) const {
    if (!unsaved_ || unsaved_->empty())
        return nullptr;
    std::error_code ignored;
    const auto held = unsaved_->find(fs::weakly_canonical(file, ignored));
    return held == unsaved_->end() ? nullptr : &held->second;
}

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
                scene.warnings.push_back({{file.string()},
                                          Severity::warning,
                                          fmt::format("no other pass reads '{}': a pass that should read it "
                                                      "needs the line #iChannel0 \"{}\"",
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
                                      fmt::format("'{}' has no pass with this file: the file is ignored",
                                                  project.filename().string())});
}

Result<Scene> load_by_project(const fs::path& folder, const PassFiles& files, const LoadOptions& options) {
    const fs::path file = folder / k_project_file;
    const Bounds bounds(folder, options.allow_outside, &options.unsaved);
    const std::string* const unsaved = bounds.unsaved(file);
    const auto json = bounds.check(file).and_then(
        [&] { return unsaved ? Result<std::string>(*unsaved) : read_file(file); });
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
                scene.common.append(plain_text(std::move(pass.code)) + '\n', place, 1);
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

Result<Scene> load_json_scene(const fs::path& path, const LoadOptions& options) {
    const Bounds bounds(path.parent_path(), options.allow_outside, &options.unsaved);
    const std::string* unsaved = bounds.unsaved(path);
    const std::string bytes = unsaved ? *unsaved : TRY(read_file(path));
    const CodeIn code = path.filename() == k_project_file ? CodeIn::files : CodeIn::json;
    auto project = TRY(read_project(bytes, path.string(), code));
    // `tidemark view folder/scene.json` opens the folder.
    for (const ProjectPass& pass : project.passes)
        if (pass.file)
            return load_folder_scene(path.parent_path().empty() ? fs::path(".") : path.parent_path(),
                                     options);
    const std::vector<std::string> names = pass_names(project);
    Scene scene;
    scene.file = path;
    scene.files.push_back(path);
    const MediaFolder media(options.media);
    auto drafts =
        TRY(draft_project(scene, {project, names, path.parent_path(), media, bounds, path.string()}));
    for (size_t i = 0; i < names.size(); ++i) {
        const std::string place = fmt::format("{}:{}", path.string(), names[i]);
        std::string text = plain_text(std::move(project.passes[i].code));
        if (!drafts.of_pass[i]) // a Common
            text += '\n';
        drafts.text_of(i, scene).append(text, place, 1);
    }
    TRY(finish_scene(scene, std::move(drafts.drafts), drafts.order));
    return scene;
}

namespace {

/// Adds the files read before the error: a change to one of them may fix it.
Error with_files(Error error, const Scene& scene) {
    for (const fs::path& file : scene.files)
        error.files.push_back(file.string());
    return error;
}

/// Loads a single file: Image, and the buffers that channels name.
Result<Scene> load_file_scene(const fs::path& path, const LoadOptions& options) {
    Scene scene;
    scene.file = path;
    const Bounds bounds(path.parent_path(), options.allow_outside, &options.unsaved);
    PassLoader loader(scene, path.parent_path(), bounds);
    Draft image;
    image.pass.name = "Image";
    image.file = path.lexically_normal();
    if (auto loaded = loader.load(loader.add(std::move(image), PassLoader::Order::by_reading)); !loaded)
        return fail(with_files(std::move(loaded.error()), scene));
    if (auto finished = loader.finish(); !finished)
        return fail(with_files(std::move(finished.error()), scene));
    return scene;
}

} // namespace

Result<Scene> load_scene(const fs::path& path, const LoadOptions& options) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored))
        return load_folder_scene(path, options);
    return path.extension() == ".json" ? load_json_scene(path, options) : load_file_scene(path, options);
}

namespace {

bool is_folder(const fs::path& path) {
    std::error_code ignored;
    return fs::is_directory(path, ignored);
}

bool is_scene_folder(const fs::path& folder) {
    return std::ranges::any_of(scene_files_in(folder), [](const fs::path& file) {
        const auto pass = parse_pass_name(file.stem().string());
        return file.filename() == k_project_file || (pass && pass->kind == PassName::Kind::image);
    });
}

/// Returns whether the name is one of ShaderToy's projects, and not of a file that Tidemark keeps.
bool is_project(const fs::path& file) {
    const std::string name = lower_case(file.filename().string());
    const auto is_kept = [&](std::string_view kept) {
        return name == kept || name.ends_with("." + std::string(kept));
    };
    return name.ends_with(".json") && !is_kept("presets.json") && !is_kept("check.json");
}

/// Returns whether a file of a folder is a scene: a shader with an entry point, or a project.
bool is_scene_in_folder(const fs::path& file) {
    if (is_folder(file))
        return is_scene_folder(file);
    const auto text =
        is_project(file) || is_shader_file(file) ? read_text_file(file) : Result<std::string>("");
    if (!text)
        return true; // its error is of use
    if (is_project(file))
        return text->find("renderpass") != std::string::npos;
    return text->find("mainImage") != std::string::npos || text->find("void main") != std::string::npos;
}

} // namespace

bool is_scene_file(const fs::path& path) {
    return is_folder(path) || is_shader_file(path) || is_project(path);
}

bool is_folder_of_scenes(const fs::path& path) {
    return is_folder(path) && !is_scene_folder(path) && !scenes_of({path}).empty();
}

std::vector<fs::path> scenes_of(const std::vector<fs::path>& paths) {
    std::vector<fs::path> scenes;
    for (const fs::path& path : paths) {
        if (!is_folder(path) || is_scene_folder(path)) {
            scenes.push_back(path);
            continue;
        }
        std::vector<fs::path> inside;
        std::error_code error;
        for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error))
            if (is_scene_in_folder(entry->path()))
                inside.push_back(entry->path());
        std::ranges::sort(inside);
        scenes.insert(scenes.end(), inside.begin(), inside.end());
    }
    return scenes;
}

} // namespace tidemark::scene
