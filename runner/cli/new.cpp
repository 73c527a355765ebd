#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "cli/commands.hpp"
#include "host/console.hpp"
#include "host/json.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace tidemark::cli {

using namespace host;
namespace fs = std::filesystem;

/// The files of scenes/, embedded in the program. A new one needs its name in runner/CMakeLists.txt, in the
/// .in file beside this one, here, and in the table of scenes.
namespace new_scene {
extern const std::string_view k_picture, k_orbit, k_march, k_buffers_common, k_buffers_buffer_a,
    k_buffers_image, k_sound_common, k_sound_sound, k_sound_image;
}

namespace {

struct TemplateFile {
    std::string_view name; ///< in the scene's folder; empty: the scene is this file
    std::string_view text;
};

struct SceneTemplate {
    std::string_view flag;    ///< for example --orbit; empty: the default scene
    std::string_view meaning; ///< of that flag, for --help
    std::vector<TemplateFile> files;

    bool is_folder() const { return !files.front().name.empty(); }
};

const std::vector<SceneTemplate>& scene_templates() {
    using namespace new_scene;
    static const std::vector<SceneTemplate> templates{
        {"", "", {{"", k_picture}}},
        {"--orbit", "A ball on a floor, turned by the mouse (iCamera)", {{"", k_orbit}}},
        {"--buffers",
         "Water with feedback: a folder with Buffer A",
         {{"common.glsl", k_buffers_common},
          {"buffer_a.glsl", k_buffers_buffer_a},
          {"image.glsl", k_buffers_image}}},
        {"--march", "Ray-marched waves, with the library's solvers", {{"", k_march}}},
        {"--sound",
         "A tune and its picture: a folder with Sound",
         {{"common.glsl", k_sound_common}, {"sound.glsl", k_sound_sound}, {"image.glsl", k_sound_image}}},
    };
    return templates;
}

struct NewOptions {
    fs::path name;
    std::vector<const SceneTemplate*> chosen;
    bool json = false;
};

Result<const SceneTemplate*> template_of(const NewOptions& options) {
    if (options.chosen.empty())
        return &scene_templates().front();
    const SceneTemplate* first = options.chosen.front();
    for (const SceneTemplate* other : options.chosen)
        if (other != first)
            return fail(ErrorCode::usage, fmt::format("{} and {} are different scenes: give one of them",
                                                      first->flag, other->flag));
    return first;
}

/// Returns the path of a scene: NAME is a folder, or a file with or without its extension.
Result<fs::path> scene_path(fs::path name, const SceneTemplate& scene) {
    if (scene.is_folder() && name.filename().empty())
        name = name.parent_path(); // for example pond/
    if (name.filename().empty() || name.filename() == "." || name.filename() == "..")
        return fail(ErrorCode::usage,
                    fmt::format("'{}' is not a name for a scene: give one as in `tidemark new waves`",
                                name.string()));
    if (scene.is_folder() || name.extension() == ".glsl" || name.extension() == ".frag")
        return name;
    return name += ".glsl";
}

/// Fails if the path exists. A dangling link also belongs to the user.
Result<void> refuse_what_is_there(const fs::path& path) {
    std::error_code error;
    if (fs::symlink_status(path, error).type() == fs::file_type::not_found)
        return {};
    return fail(ErrorCode::write, fmt::format("'{}' already exists: give another name", path.string()));
}

Result<std::vector<fs::path>> write_scene(const fs::path& path, const SceneTemplate& scene) {
    if (scene.is_folder())
        TRY(make_folder(OutputPath::typed(path)));
    std::vector<fs::path> written;
    for (const TemplateFile& file : scene.files) {
        const OutputPath output =
            file.name.empty() ? OutputPath::typed(path) : OutputPath::typed(path) / file.name;
        TRY(write_file(output, file.text));
        written.push_back(output.path());
    }
    return written;
}

Result<int> make_scene(const NewOptions& options) {
    const SceneTemplate& scene = *TRY(template_of(options));
    const fs::path path = TRY(scene_path(options.name, scene));
    TRY(refuse_what_is_there(path));
    nlohmann::ordered_json report = {{"tidemark", k_version}, {"scene", path.string()}};
    for (const fs::path& file : TRY(write_scene(path, scene))) {
        say(fmt::format("wrote {}", file.string()));
        report["files"].push_back(file.string());
    }
    say(fmt::format("open it with: tidemark {}", shell_word(path.string())));
    return options.json ? put(dump(report, 2) + "\n").map([] { return 0; }) : Result<int>(0);
}

} // namespace

void add_new(Command app, Action& chosen) {
    auto options = std::make_shared<NewOptions>();
    Command command = app.add_subcommand("new", "Writes a commented example scene to start from");
    command.add_option("NAME", options->name, "Name of the scene: a file NAME.glsl, or a folder").required();
    for (const SceneTemplate& scene : scene_templates())
        if (!scene.flag.empty())
            command.add_flag(
                std::string(scene.flag), [options, &scene] { options->chosen.push_back(&scene); },
                std::string(scene.meaning));
    command.add_flag("--json", options->json, "Prints one JSON object");
    command.on_call([options, &chosen] { chosen = [options] { return make_scene(*options); }; });
}

} // namespace tidemark::cli
