#include "scene/project.hpp"

#include "base/error.hpp"
#include "scene/json_text.hpp"
#include "scene/names.hpp"
#include "scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::scene {
namespace {

using Kind = ProjectPass::Kind;

constexpr std::pair<std::string_view, Kind> k_kinds[] = {
    {"image", Kind::image}, {"buffer", Kind::buffer},   {"common", Kind::common},
    {"sound", Kind::sound}, {"cubemap", Kind::cubemap},
};

/// Returns the value of the first key, which is the API's; if it is empty, of the second, the site's.
std::string either(const Json& object, const char* first, const char* second) {
    std::string text = as_text(object, first);
    return text.empty() ? as_text(object, second) : text;
}

/// Returns a boolean as text, since ShaderToy writes them as strings.
std::string flag(const Json& object, const char* key) {
    const auto found = object.find(key);
    if (found != object.end() && found->is_boolean())
        return found->get<bool>() ? "true" : "false";
    return as_text(object, key);
}

class ProjectReader {
public:
    ProjectReader(const Json& passes, const std::string& file, CodeIn code)
        : passes_(passes), file_(file), code_in_(code) {}

    Result<Project> read() {
        if (!passes_.is_array() || passes_.empty())
            return refuse("renderpass is not a list of passes");
        if (passes_.size() > k_most_passes)
            return refuse(fmt::format("it has {} passes: ShaderToy has at most 8", passes_.size()));
        for (const Json& pass : passes_)
            TRY(read_pass(pass));
        const std::vector<std::string> names = pass_names(project_);
        for (size_t i = 0; i < names.size(); ++i)
            if (std::optional<std::string>& named = project_.passes[i].file; named && named->empty())
                named = file_name_of(names[i]);
        return std::move(project_);
    }

private:
    /// ShaderToy allows 8; a list of thousands is something else.
    static constexpr size_t k_most_passes = 64;

    tl::unexpected<Error> refuse(std::string message) const {
        return fail(error_at({file_}, std::move(message)));
    }

    Result<void> read_pass(const Json& json) {
        const size_t number = project_.passes.size() + 1;
        if (!json.is_object())
            return refuse(fmt::format("pass {} is not an object", number));
        ProjectPass pass;
        pass.name = as_text(json, "name");
        const std::string called =
            pass.name.empty() ? fmt::format("pass {}", number) : fmt::format("the pass '{}'", pass.name);
        const auto kind = kind_of(json, pass.name);
        if (!kind)
            return refuse(fmt::format("{} has the unknown type '{}': ShaderToy has image, buffer, common, "
                                      "cubemap and sound",
                                      called, as_text(json, "type")));
        pass.kind = *kind;
        const auto code = json.find("code");
        if (code != json.end() && code->is_string())
            pass.code = code->get<std::string>();
        else if (const std::string named =
                     code != json.end() && code->is_object() ? as_text(*code, "file") : "";
                 !named.empty()) {
            if (code_in_ == CodeIn::json)
                return refuse(fmt::format("the code of {} is in the file '{}': this works only in the "
                                          "scene.json of a scene folder; elsewhere code must be a string",
                                          called, named));
            pass.file = named;
        } else if (code_in_ == CodeIn::json || (code != json.end() && !code->is_null()))
            return refuse(fmt::format("{} has no code", called));
        else
            pass.file.emplace(); // named in read(), when all passes are known
        pass.size = as_text(json, "size");
        read_outputs(json, pass);
        read_inputs(json, called, pass);
        project_.passes.push_back(std::move(pass));
        return {};
    }

    /// Returns the kind by the pass's type; if that is missing, by its name.
    static std::optional<Kind> kind_of(const Json& json, std::string_view name) {
        const std::string type = as_text(json, "type");
        for (const auto& [word, kind] : k_kinds)
            if (word == type)
                return kind;
        if (!type.empty())
            return std::nullopt;
        const auto named = parse_pass_name(name);
        return named ? named->kind : Kind::image;
    }

    static void read_outputs(const Json& json, ProjectPass& pass) {
        const auto outputs = json.find("outputs");
        if (outputs == json.end() || !outputs->is_array())
            return;
        for (const Json& output : *outputs)
            if (output.is_object() && (pass.output.empty() || as_text(output, "channel") == "0"))
                pass.output = as_text(output, "id");
    }

    void read_inputs(const Json& json, const std::string& called, ProjectPass& pass) {
        const auto inputs = json.find("inputs");
        if (inputs == json.end() || !inputs->is_array())
            return;
        for (const Json& input : *inputs)
            if (input.is_object())
                read_input(input, called, pass);
    }

    void read_input(const Json& json, const std::string& called, ProjectPass& pass) {
        ProjectInput input;
        const std::string channel = as_text(json, "channel");
        if (channel.size() != 1 || channel[0] < '0' || channel[0] > '3') {
            project_.warnings.push_back(
                {{file_},
                 Severity::warning,
                 fmt::format("{} has an input for channel '{}', which is ignored: channels are 0 to 3",
                             called, channel)});
            return;
        }
        input.channel = channel[0] - '0';
        input.type = either(json, "ctype", "type");
        input.id = as_text(json, "id");
        input.source = either(json, "src", "filepath");
        const auto sampler = json.find("sampler");
        if (sampler != json.end() && sampler->is_object()) {
            input.filter = as_text(*sampler, "filter");
            input.wrap = as_text(*sampler, "wrap");
            input.vflip = flag(*sampler, "vflip");
        }
        pass.inputs.push_back(std::move(input));
    }

    const Json& passes_;
    const std::string& file_;
    const CodeIn code_in_;
    Project project_;
};

/// Returns a name for a pass of a kind that ShaderToy has only once.
std::string numbered(std::string_view name, int count) {
    return count == 1 ? std::string(name) : fmt::format("{} {}", name, count);
}

} // namespace

Result<Project> read_passes(const Json& passes, const std::string& file, CodeIn code) {
    return ProjectReader(passes, file, code).read();
}

Result<Project> read_project(std::string_view text, const std::string& file, CodeIn code) {
    auto json = TRY(parse_json(text, file));
    const auto passes = TRY(find_passes(json, file));
    return read_passes(*passes, file, code);
}

std::vector<std::string> pass_names(const Project& project) {
    std::vector<std::string> names(project.passes.size());
    const auto is_free = [&](const std::string& name) {
        return std::find(names.begin(), names.end(), name) == names.end();
    };
    // Buffers are named by what they draw, then by their author's name, then by the next free letter.
    for (int round = 0; round < 3; ++round)
        for (size_t i = 0; i < names.size(); ++i) {
            const ProjectPass& pass = project.passes[i];
            if (pass.kind != Kind::buffer || !names[i].empty())
                continue;
            const auto named = parse_pass_name(pass.name);
            std::optional<int> number;
            if (round == 0)
                number = buffer_number(pass.output);
            else if (round == 1 && named && named->kind == Kind::buffer)
                number = named->number;
            else if (round == 2)
                for (number = 0; !is_free(buffer_name(*number));)
                    ++*number;
            if (number && is_free(buffer_name(*number)))
                names[i] = buffer_name(*number);
        }
    int counts[5] = {};
    for (size_t i = 0; i < names.size(); ++i) {
        const Kind kind = project.passes[i].kind;
        const int count = ++counts[size_t(kind)];
        switch (kind) {
        case Kind::common: names[i] = numbered("Common", count); break;
        case Kind::cubemap: names[i] = numbered("Cube A", count); break;
        case Kind::image: names[i] = numbered("Image", count); break;
        case Kind::sound: names[i] = numbered("Sound", count); break;
        case Kind::buffer: break;
        }
    }
    return names;
}

std::optional<int> buffer_number(std::string_view id) {
    constexpr std::string_view k_ids[][2] = {
        {"257", "4dXGR8"}, {"258", "XsXGR8"}, {"259", "4sXGR8"}, {"260", "XdfGR8"}};
    for (int i = 0; i < 4; ++i)
        if (id == k_ids[i][0] || id == k_ids[i][1])
            return i;
    return std::nullopt;
}

bool is_cube_id(std::string_view id) {
    return id == "41" || id == "4dX3Rr";
}

namespace fs = std::filesystem;
namespace {

/// Returns the buffer of ShaderToy's preview picture: `/media/previz/buffer02.png` is C.
std::optional<int> previz_buffer(std::string_view source) {
    constexpr std::string_view k_name = "previz/buffer0";
    const size_t at = source.find(k_name);
    if (at == std::string_view::npos || at + k_name.size() >= source.size())
        return std::nullopt;
    const char digit = source[at + k_name.size()];
    return digit >= '0' && digit <= '3' ? std::optional(digit - '0') : std::nullopt;
}

/// Also matches `/media/a//media/previz/cubemap00.png`.
bool is_previz_cube(std::string_view source) {
    return source.find("previz/cubemap0") != std::string_view::npos;
}

bool is_remote(std::string_view source) {
    return source.find("://") != std::string_view::npos || source.starts_with("data:") ||
           source.starts_with("//");
}

bool is_there(const fs::path& file) {
    std::error_code ignored;
    return fs::exists(file, ignored);
}

/// Shortens a name for messages: a source may be a whole picture in base 64.
std::string shown(const ProjectInput& input) {
    const std::string& name = input.source.empty() ? input.id : input.source;
    return name.size() <= 120 ? name : name.substr(0, 120) + "...";
}

} // namespace

InputReader::Kind InputReader::kind_of(const ProjectInput& input) {
    constexpr std::pair<std::string_view, Kind> k_types[] = {
        {"texture", Kind::picture},   {"buffer", Kind::buffer},     {"cubemap", Kind::cubemap},
        {"volume", Kind::volume},     {"keyboard", Kind::keyboard}, {"music", Kind::music},
        {"musicstream", Kind::music}, {"mic", Kind::microphone},    {"video", Kind::video},
        {"webcam", Kind::webcam},
    };
    constexpr std::pair<std::string_view, Kind> k_ids[] = {
        {"33", Kind::keyboard}, {"4dXGRr", Kind::keyboard}, {"31", Kind::webcam}, {"32", Kind::microphone}};
    for (const auto& [word, kind] : k_types)
        if (input.type == word)
            return kind;
    if (buffer_number(input.id) || previz_buffer(input.source))
        return Kind::buffer;
    if (is_cube_id(input.id) || is_previz_cube(input.source))
        return Kind::cubemap;
    for (const auto& [id, kind] : k_ids)
        if (input.id == id)
            return kind;
    constexpr Kind k_media_kinds[] = {Kind::picture, Kind::cubemap, Kind::volume, Kind::video, Kind::music};
    if (const Media* media = media_of(input))
        return k_media_kinds[size_t(media->kind)];
    if (const auto named = parse_pass_name(input.source))
        return named->kind == ProjectPass::Kind::cubemap ? Kind::cubemap : Kind::buffer;
    if (input.source.empty())
        return Kind::none;
    return k_media_kinds[size_t(media_kind_of(fs::path(input.source)))];
}

const Media* InputReader::media_of(const ProjectInput& input) {
    const Media* media = find_media(input.source);
    return media || !input.source.empty() ? media : find_media_by_id(input.id);
}

Sampling InputReader::sampling_of(const ProjectInput& input, Kind kind) {
    if (kind == Kind::keyboard)
        return k_keyboard_sampling;
    if (kind == Kind::music || kind == Kind::microphone) // ShaderToy ignores the sampler for these
        return k_buffer_sampling;
    Sampling sampling = kind == Kind::picture   ? k_texture_sampling
                        : kind == Kind::volume  ? k_volume_sampling
                        : kind == Kind::cubemap ? k_cubemap_sampling
                                                : k_buffer_sampling;
    if (input.filter == "nearest")
        sampling.magnify = sampling.minify = Filter::nearest;
    else if (input.filter == "linear" || input.filter == "mipmap")
        sampling.magnify = sampling.minify = Filter::linear;
    if (!input.filter.empty())
        sampling.mipmaps = input.filter == "mipmap" ? Mipmaps::linear : Mipmaps::none;
    if (input.wrap == "repeat")
        sampling.wrap = Wrap::repeat;
    else if (input.wrap == "clamp")
        sampling.wrap = Wrap::clamp;
    if (!input.vflip.empty())
        sampling.vflip = input.vflip == "true";
    return sampling;
}

Result<Channel> InputReader::read(const ProjectInput& input) {
    const Kind kind = kind_of(input);
    auto what = TRY(input_of(input, kind));
    return Channel{std::move(what), sampling_of(input, kind), {}};
}

Result<ChannelInput> InputReader::input_of(const ProjectInput& input, Kind kind) {
    switch (kind) {
    case Kind::none: return Unbound{};
    case Kind::buffer: return output_of(input);
    case Kind::keyboard: return Keyboard{};
    case Kind::microphone: return live_input("microphone", {Music{}, "ShaderToy's signal for silence"});
    case Kind::webcam: return live_input("webcam", {Video{}, "a generated picture of 640x480"});
    case Kind::cubemap:
        if (is_cube_id(input.id) || is_previz_cube(input.source) || parse_pass_name(input.source))
            return cube_output();
        return media_input(input, MediaKind::cubemap);
    case Kind::picture: return media_input(input, MediaKind::picture);
    case Kind::volume: return media_input(input, MediaKind::volume);
    case Kind::music: return media_input(input, MediaKind::music);
    case Kind::video: return media_input(input, MediaKind::video);
    }
    return Unbound{};
}

/// Returns the buffer whose output has the input's id; else the one with that id in the other dialect, or
/// with that preview picture.
ChannelInput InputReader::output_of(const ProjectInput& input) const {
    const auto& passes = context_.project.passes;
    for (size_t i = 0; i < passes.size(); ++i)
        if (passes[i].kind == ProjectPass::Kind::buffer && !input.id.empty() && passes[i].output == input.id)
            return PassOutput{i};
    auto number = buffer_number(input.id);
    if (!number)
        number = previz_buffer(input.source);
    if (const auto named = parse_pass_name(input.source); !number && named)
        number = named->number;
    if (!number)
        return Unbound{};
    const auto& names = context_.names;
    const auto named = std::find(names.begin(), names.end(), buffer_name(*number));
    return named == names.end() ? ChannelInput(Unbound{}) : PassOutput{size_t(named - names.begin())};
}

ChannelInput InputReader::cube_output() const {
    const auto& passes = context_.project.passes;
    for (size_t i = passes.size(); i-- > 0;)
        if (passes[i].kind == ProjectPass::Kind::cubemap)
            return PassOutput{i};
    return Unbound{TextureKind::cube};
}

Result<ChannelInput> InputReader::media_input(const ProjectInput& input, MediaKind kind) {
    auto files = TRY(files_of(input, kind));
    const Media* media = media_of(input);
    if (files.empty())
        return instead_of(input, media, substitute_for(kind, media));
    switch (kind) {
    case MediaKind::picture:
        return Picture{files.front(), media && media->kind == kind && media->channels == 1};
    case MediaKind::cubemap: return Cubemap{std::move(files)};
    case MediaKind::volume: return Volume{files.front()};
    case MediaKind::video: return Video{files.front()};
    case MediaKind::music: break;
    }
    return Music{files.front()};
}

/// Returns a file of the project's own, else one of ShaderToy's media.
Result<std::vector<fs::path>> InputReader::files_of(const ProjectInput& input, MediaKind kind) const {
    const Media* media = media_of(input);
    const std::string source = input.source.empty() && media ? std::string(media->hash) : input.source;
    if (source.empty())
        return std::vector<fs::path>{};
    if (!is_remote(source) && !source.starts_with('/') && !input.source.empty()) {
        const fs::path own = (context_.folder / source).lexically_normal();
        if (auto inside = context_.bounds.check(own); !inside)
            return fail(error_at({context_.file}, inside.error().message));
        if (is_there(own))
            return std::vector{own};
    }
    if (kind == MediaKind::cubemap)
        return context_.media.find_cubemap(source);
    fs::path found = context_.media.find(source);
    return found.empty() ? std::vector<fs::path>{} : std::vector{std::move(found)};
}

/// Substitutes a live input and warns of it once: it is live only in a window that was started with that
/// option.
ChannelInput InputReader::live_input(const std::string& name, Substitute instead) {
    if (warned_.insert(name).second)
        warnings_.push_back(
            {{context_.file},
             Severity::warning,
             fmt::format("'{0}' is a live input: {1} replaces it without view --{0}", name, instead.name)});
    return std::move(instead.input);
}

ChannelInput InputReader::instead_of(const ProjectInput& input, const Media* media, Substitute instead) {
    if (instead.name.empty() || !warned_.insert(input.source.empty() ? input.id : input.source).second)
        return std::move(instead.input);
    std::string what = fmt::format("'{}'", shown(input));
    if (media && !media->title.empty())
        what += fmt::format(" ({})", media->title);
    warnings_.push_back(
        {{context_.file},
         Severity::warning,
         fmt::format("{} was not found: {} replaces it (--media DIR names the folder with such files)", what,
                     instead.name)});
    return std::move(instead.input);
}

namespace {

using Kind = ProjectPass::Kind;

/// Returns nullopt if the project states no size.
Result<std::optional<Extent>> read_size(const std::string& text, const std::string& file) {
    const auto size = size_of_text(text);
    if (!text.empty() && !size)
        return fail(error_at(
            {file},
            fmt::format("the size of Image is '{}': give WIDTHxHEIGHT in pixels, as in 800x450", text)));
    return size;
}

/// Returns whether a later pass replaces this one: ShaderToy has one pass of each kind, except buffers and
/// Common.
bool is_replaced(const Project& project, size_t pass) {
    const Kind kind = project.passes[pass].kind;
    return kind != Kind::buffer && kind != Kind::common &&
           std::any_of(project.passes.begin() + std::ptrdiff_t(pass) + 1, project.passes.end(),
                       [&](const ProjectPass& later) { return later.kind == kind; });
}

std::string_view word_for(Kind kind) {
    return kind == Kind::image ? "Image" : kind == Kind::cubemap ? "Cube A" : "Sound";
}

} // namespace

PassKind kind_of(PassName::Kind kind) {
    switch (kind) {
    case Kind::buffer: return PassKind::buffer;
    case Kind::cubemap: return PassKind::cubemap;
    case Kind::sound: return PassKind::sound;
    case Kind::common:
    case Kind::image: break;
    }
    return PassKind::image;
}

Result<ProjectDrafts> draft_project(Scene& scene, InputReader::Context context) {
    const Project& project = context.project;
    const std::string file = context.file;
    scene.warnings.insert(scene.warnings.end(), project.warnings.begin(), project.warnings.end());
    if (std::none_of(project.passes.begin(), project.passes.end(),
                     [](const ProjectPass& pass) { return pass.kind == Kind::image; }))
        return fail(error_at({file}, "this project has no Image pass: there is nothing to show"));

    ProjectDrafts result;
    for (size_t i = 0; i < project.passes.size(); ++i) {
        const ProjectPass& pass = project.passes[i];
        if (pass.kind == Kind::common) {
            result.of_pass.emplace_back();
            continue;
        }
        result.of_pass.emplace_back(result.drafts.size());
        Draft draft;
        draft.pass.kind = kind_of(pass.kind);
        draft.pass.name = context.names[i];
        result.drafts.push_back(std::move(draft));
        if (pass.kind == Kind::image)
            scene.size = TRY(read_size(pass.size, file));
        if (!is_replaced(project, i)) {
            result.order.push_back(result.drafts.size() - 1);
            result.drafts.back().pass.name =
                pass.kind == Kind::buffer ? context.names[i] : word_for(pass.kind);
            continue;
        }
        scene.warnings.push_back({{file},
                                  Severity::warning,
                                  fmt::format("the project has several {} passes: only the last one is drawn",
                                              word_for(pass.kind))});
    }
    InputReader inputs(std::move(context));
    for (size_t i = 0; i < project.passes.size(); ++i) {
        if (!result.of_pass[i])
            continue;
        Channels& channels = result.drafts[*result.of_pass[i]].pass.channels;
        for (Channel& channel : channels)
            channel.input = Unbound{};
        for (const ProjectInput& input : project.passes[i].inputs) {
            auto channel = TRY(inputs.read(input));
            if (size_t* read = source_pass(channel.input))
                *read = *result.of_pass[*read];
            channels[size_t(input.channel)] = std::move(channel);
        }
    }
    auto warnings = inputs.take_warnings();
    scene.warnings.insert(scene.warnings.end(), warnings.begin(), warnings.end());
    return result;
}

std::string plain_text(std::string text) {
    std::replace(text.begin(), text.end(), '\0', ' ');
    return text::with_plain_line_ends(std::move(text));
}

} // namespace tidemark::scene
