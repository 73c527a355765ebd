#include "scene/load_scene.hpp"

#include "scene/bounds.hpp"
#include "scene/folder_scene.hpp"
#include "scene/json_scene.hpp"
#include "scene/pass_loader.hpp"

namespace tidemark::scene {
namespace fs = std::filesystem;
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

} // namespace tidemark::scene
