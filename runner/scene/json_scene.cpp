#include "scene/json_scene.hpp"

#include "base/file.hpp"
#include "base/try.hpp"
#include "scene/bounds.hpp"
#include "scene/builder.hpp"
#include "scene/folder_scene.hpp"
#include "scene/media.hpp"
#include "scene/project.hpp"
#include "scene/project_drafts.hpp"

#include <fmt/format.h>

namespace tidemark::scene {
namespace fs = std::filesystem;

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
        text::MappedText& text = drafts.text_of(i, scene);
        text.append(plain_text(std::move(project.passes[i].code)), place, 1);
    }
    TRY(finish_scene(scene, std::move(drafts.drafts), drafts.order));
    return scene;
}

} // namespace tidemark::scene
