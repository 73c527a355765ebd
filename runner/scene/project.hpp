// A ShaderToy project as its JSON tells it, whatever the dialect of the JSON: passes with their code and
// their inputs, still by ShaderToy's names. What the names mean is decided in
// project_inputs.hpp.
#pragma once

#include "base/result.hpp"
#include "scene/pass_names.hpp"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::scene {

/// What one channel of a pass reads. All texts are as the JSON has them (numbers as their digits), empty
/// where it has nothing.
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
    std::string name;   ///< the author's, for messages only
    std::string output; ///< id of what it draws
    std::string code;
    std::optional<std::string> file; ///< scene.json: the code stands in that file of the folder
    std::vector<ProjectInput> inputs;
    std::string size{}; ///< of Image: 800x450, as its #iSize had it
};

struct Project {
    std::vector<ProjectPass> passes; ///< in the order of the JSON
    std::vector<Diagnostic> warnings;
};

/// Where the code of a pass may stand: in the JSON, or in files beside it, which `"code": {"file": "…"}`
/// names; a pass that says nothing has the file of its name.
enum class CodeIn { json, files };

/// Reads the JSON of ShaderToy's API, of its site, or of 2014, alone or as a list of one. `file` is for the
/// messages.
Result<Project> read_project(std::string_view json, const std::string& file, CodeIn code = CodeIn::json);

/// The same for the list of passes that find_passes (scene/json_text.hpp) finds in a JSON.
Result<Project> read_passes(const nlohmann::ordered_json& passes, const std::string& file, CodeIn code);

/// A name for each pass, unique and the same in every project: `Common`, `Buffer A` … by what it draws, not
/// by the author's name; `Cube A`, `Image`, `Sound`.
std::vector<std::string> pass_names(const Project& project);

/// 0 to 3 for the id of Buffer A to D in either form.
std::optional<int> buffer_number(std::string_view id);
/// Whether that is the id of Cube A.
bool is_cube_id(std::string_view id);

} // namespace tidemark::scene
