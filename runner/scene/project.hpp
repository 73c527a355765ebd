// A ShaderToy project as its JSON has it, in any of the JSON's dialects: passes with code and inputs, still
// under ShaderToy's names. project.hpp resolves the names.
#pragma once

#include "base/error.hpp"
#include "scene/channel.hpp"
#include "scene/load_scene.hpp"
#include "scene/names.hpp"
#include "scene/pass_loader.hpp"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <optional>
#include <set>
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

// Resolves an input of ShaderToy's JSON to a Channel: its kind, its file or substitute, its sampler.

/// Reads the inputs of one project. Checks which media files exist; opens none.
class InputReader {
public:
    /// The names that an input can refer to.
    struct Context {
        const Project& project;
        const std::vector<std::string>& names; ///< names of its passes (pass_names)
        std::filesystem::path folder;          ///< the project's own files are relative to it
        const MediaFolder& media;
        const Bounds& bounds;
        std::string file; ///< the JSON, for messages
    };
    explicit InputReader(Context context) : context_(std::move(context)) {}

    /// PassOutput::pass is an index into the project's passes. Fails only on a file out of bounds.
    Result<Channel> read(const ProjectInput& input);

    /// Returns one warning for each missing file or live input.
    std::vector<Diagnostic> take_warnings() { return std::move(warnings_); }

private:
    enum class Kind { none, picture, buffer, cubemap, volume, keyboard, music, microphone, video, webcam };

    static Kind kind_of(const ProjectInput& input);
    static const Media* media_of(const ProjectInput& input);
    static Sampling sampling_of(const ProjectInput& input, Kind kind);
    Result<ChannelInput> input_of(const ProjectInput& input, Kind kind);
    ChannelInput output_of(const ProjectInput& input) const;
    ChannelInput cube_output() const;
    Result<ChannelInput> media_input(const ProjectInput& input, MediaKind kind);
    Result<std::vector<std::filesystem::path>> files_of(const ProjectInput& input, MediaKind kind) const;
    ChannelInput live_input(const std::string& name, Substitute instead);
    ChannelInput instead_of(const ProjectInput& input, const Media* media, Substitute instead);

    Context context_;
    std::vector<Diagnostic> warnings_;
    std::set<std::string> warned_; ///< sources and ids already warned of
};

// Turns the passes of a project into drafts: kind, name and channels, with texts still empty.

/// Returns the pass kind of a tab; Common, which is not a pass, counts as Image.
PassKind kind_of(PassName::Kind kind);

struct ProjectDrafts {
    std::vector<Draft> drafts;
    std::vector<size_t> order; ///< drawing order
    std::vector<std::optional<size_t>>
        of_pass; ///< index of the draft of each of the project's passes; none for Common

    /// Returns the text to which a pass's code is appended: its draft's, or the scene's Common.
    text::MappedText& text_of(size_t pass, Scene& scene) {
        return of_pass[pass] ? drafts[*of_pass[pass]].pass.text : scene.common;
    }
};

/// Makes the drafts. Fails without an Image pass; of several passes of a kind that ShaderToy has once, the
/// last one counts, with a warning. Adds the warnings of the project and its inputs to the scene's.
Result<ProjectDrafts> draft_project(Scene& scene, InputReader::Context context);

/// Normalises a text: plain line ends, and a blank for each NUL.
std::string plain_text(std::string text);

} // namespace tidemark::scene
