#include "scene/project_files.hpp"

#include "base/file.hpp"
#include "base/try.hpp"
#include "scene/folder_scene.hpp"
#include "scene/json_text.hpp"
#include "scene/pass_names.hpp"
#include "scene/project.hpp"

#include <fmt/format.h>

namespace tidemark::scene {
namespace fs = std::filesystem;
namespace {} // namespace

Result<std::vector<ProjectFile>> split_project(std::string_view text, const std::string& file) {
    auto json = TRY(parse_json(text, file));
    const auto passes = TRY(find_passes(json, file));
    auto project = TRY(read_passes(*passes, file, CodeIn::json));
    const std::vector<std::string> names = pass_names(project);
    std::vector<ProjectFile> files;
    for (size_t i = 0; i < names.size(); ++i) {
        ProjectPass& pass = project.passes[i];
        files.push_back({file_name_of(names[i]), std::move(pass.code)});
        (*passes)[i]["code"] = Json{{"file", files.back().name}};
    }
    files.push_back({k_project_file, json.dump(k_json_indent) + "\n"});
    return files;
}

Result<std::string> join_project(const fs::path& folder, const Bounds& bounds) {
    const fs::path file = folder / k_project_file;
    const auto text = bounds.check(file).and_then([&] { return read_file(file); });
    if (!text)
        return fail(text.error());
    auto json = TRY(parse_json(*text, file.string()));
    const auto passes = TRY(find_passes(json, file.string()));
    const auto project = TRY(read_passes(*passes, file.string(), CodeIn::files));
    for (size_t i = 0; i < project.passes.size(); ++i) {
        if (!project.passes[i].file)
            continue;
        const fs::path code_file = (folder / *project.passes[i].file).lexically_normal();
        auto code = bounds.check(code_file).and_then([&] { return read_file(code_file); });
        if (!code)
            return fail(std::move(code.error()));
        Json value = *std::move(code);
        try { // JSON is Unicode: bytes in another encoding cannot be stored
            (void)value.dump();
        } catch (const Json::type_error&) {
            return fail(ErrorCode::load,
                        fmt::format("'{}' is not UTF-8: save it as that, for JSON is", code_file.string()));
        }
        (*passes)[i]["code"] = std::move(value);
    }
    return json.dump(k_json_indent) + "\n";
}

} // namespace tidemark::scene
