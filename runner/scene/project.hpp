// A ShaderToy project as its JSON has it, in any of the JSON's dialects: passes with code and inputs, still
// under ShaderToy's names. project_inputs.hpp resolves the names.
#pragma once

#include "base/result.hpp"
#include "scene/pass_names.hpp"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::scene {

/// The input of one channel of a pass. All texts are as in the JSON (numbers as their digits), empty if
/// missing.
struct ProjectInput {
    int channel = 0;
    std::string type; ///< texture, buffer, cubemap, volume, keyboard, music, musicstream, mic, video, webcam
    std::string id;   ///< 257 or 4dXGR8
    std::string source; ///< /media/a/….png
    std::string filter; ///< nearest, linear, mipmap
    std::string wrap;   ///< clamp, repeat
    std::string vflip;  ///< true, false
};

struct ProjectPass {
    using Kind = PassName::Kind;
    Kind kind = Kind::image;
    std::string name;   ///< the author's name, for messages only
    std::string output; ///< id of its output
    std::string code;
    std::optional<std::string> file; ///< scene.json: the file of the folder that holds the code
    std::vector<ProjectInput> inputs;
    std::string size{}; ///< for Image: its #iSize, as in 800x450
};

struct Project {
    std::vector<ProjectPass> passes; ///< in the order of the JSON
    std::vector<Diagnostic> warnings;
};

/// The place of the passes' code: in the JSON, or in files next to it that `"code": {"file": "…"}` names. In
/// a project with files, a pass without code has the file of its name.
enum class CodeIn { json, files };

/// Reads the JSON of ShaderToy's API, of its site, or of 2014, alone or as a list of one. `file` is for
/// messages.
Result<Project> read_project(std::string_view json, const std::string& file, CodeIn code = CodeIn::json);

/// Reads the list of passes that find_passes (scene/json_text.hpp) returns.
Result<Project> read_passes(const nlohmann::ordered_json& passes, const std::string& file, CodeIn code);

/// Returns a name for each pass, unique and the same in every project: `Common`, `Buffer A` … by output, not
/// by the author's name; `Cube A`, `Image`, `Sound`.
std::vector<std::string> pass_names(const Project& project);

/// Returns 0 to 3 for the id of Buffer A to D, in the API's or the site's form.
std::optional<int> buffer_number(std::string_view id);
/// Returns whether it is the id of Cube A.
bool is_cube_id(std::string_view id);

} // namespace tidemark::scene
