#include "scene/project_exchange.hpp"

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "base/overloaded.hpp"
#include "scene/host_uniforms.hpp"
#include "scene/json_text.hpp"
#include "scene/load_scene.hpp"
#include "scene/names.hpp"
#include "scene/project.hpp"
#include "scene/scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <utility>
#include <vector>

namespace tidemark::scene {
namespace {

constexpr std::string_view k_key = "\"renderpass\"";
// Limits that keep the time linear on pages that hold no project. A project has its key within some
// kilobytes, after its description.
constexpr size_t k_most_keys = 16;
constexpr size_t k_most_braces = 256;
constexpr size_t k_farthest_key = size_t{1} << 16;

/// Returns the position after the string that begins at `at`; JSON strings have no line ends.
size_t string_end(std::string_view text, size_t at) {
    for (++at; at < text.size() && text[at] != '"' && text[at] != '\n'; ++at)
        if (text[at] == '\\')
            ++at;
    return at + 1;
}

struct Walked {
    size_t at;
    int depth; ///< number of brackets open there
};

/// Walks from the bracket at `begin` to its counterpart, and past it, or to `end`.
Walked walk(std::string_view text, size_t begin, size_t end) {
    Walked walked = {begin, 0};
    do {
        const char c = text[walked.at];
        walked.depth += (c == '{' || c == '[') - (c == '}' || c == ']');
        walked.at = c == '"' ? string_end(text, walked.at) : walked.at + 1;
    } while (walked.at < end && walked.depth > 0);
    return walked;
}

/// Returns the object that has the key at `key` as a direct member; empty if there is none. The text before
/// it may be any script, so its brace is searched backwards.
std::string_view object_around(std::string_view text, size_t key) {
    size_t brace = key;
    for (size_t tried = 0; tried < k_most_braces && brace > 0; ++tried) {
        brace = text.rfind('{', brace - 1);
        if (brace == text.npos || key - brace > k_farthest_key)
            break;
        const Walked to_key = walk(text, brace, key);
        if (to_key.at != key || to_key.depth != 1)
            continue;
        const Walked whole = walk(text, brace, text.size());
        return whole.depth == 0 ? text.substr(brace, whole.at - brace) : std::string_view();
    }
    return {};
}

std::vector<std::string> objects_in(std::string_view text) {
    std::vector<std::string> objects;
    size_t key = text.find(k_key);
    for (size_t count = 0; count < k_most_keys && key != text.npos; ++count) {
        const std::string_view object = object_around(text, key);
        if (!object.empty())
            objects.emplace_back(object);
        const size_t behind = object.empty() ? key + 1 : size_t(object.end() - text.begin());
        key = text.find(k_key, behind);
    }
    return objects;
}

/// The scripts of a page, and its text without them.
struct Page {
    std::string scripts;
    std::string rest;
};

size_t find_tag(std::string_view page, std::string_view tag, size_t from) {
    const auto same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
    const auto found =
        std::search(page.begin() + std::ptrdiff_t(from), page.end(), tag.begin(), tag.end(), same);
    return found == page.end() ? page.size() : size_t(found - page.begin());
}

Page take_apart(std::string_view text) {
    Page page;
    for (size_t at = 0; at < text.size();) {
        const size_t script = find_tag(text, "<script", at);
        const size_t end = find_tag(text, "</script", script);
        page.rest.append(text.substr(at, script - at)).append("\n");
        page.scripts.append(text.substr(script, end - script)).append("\n");
        at = end;
    }
    return page;
}

/// Replaces HTML entities by their characters.
std::string without_entities(std::string_view text) {
    constexpr std::array<std::pair<std::string_view, char>, 7> k_entities = {{{"&quot;", '"'},
                                                                              {"&#34;", '"'},
                                                                              {"&lt;", '<'},
                                                                              {"&gt;", '>'},
                                                                              {"&#39;", '\''},
                                                                              {"&nbsp;", ' '},
                                                                              {"&amp;", '&'}}};
    std::string plain;
    while (!text.empty()) {
        const auto* entity = std::find_if(k_entities.begin(), k_entities.end(),
                                          [&](const auto& each) { return text.starts_with(each.first); });
        const bool found = entity != k_entities.end();
        plain += found ? entity->second : text.front();
        text.remove_prefix(found ? entity->first.size() : 1);
    }
    return plain;
}

} // namespace

bool is_page(std::string_view text) {
    const size_t first = text.find_first_not_of("\xef\xbb\xbf \t\r\n");
    return first != text.npos && text[first] == '<';
}

std::vector<std::string> projects_in_page(std::string_view text) {
    Page page = take_apart(text);
    auto found = objects_in(page.scripts);
    if (found.empty())
        found = objects_in(without_entities(page.rest));
    if (!found.empty())
        return found;
    // In an attribute, quotes are entities; a plain quote ends the attribute.
    std::replace(page.rest.begin(), page.rest.end(), '"', '\n');
    return objects_in(without_entities(page.rest));
}

namespace {

constexpr size_t k_id_length = 6;

bool is_id(std::string_view text) {
    return text.size() == k_id_length &&
           std::all_of(text.begin(), text.end(), [](unsigned char c) { return c < 128 && std::isalnum(c); });
}

/// Returns an empty text if the project does not state its id.
std::string id_of(const Json& project) {
    const Json* inner = &project;
    for (const char* key : {"Shader", "info"}) {
        const auto found = inner->is_object() ? inner->find(key) : inner->end();
        if (found != inner->end())
            inner = &*found;
    }
    return inner == &project ? "" : as_text(*inner, "id");
}

/// Returns the entries of a list or an export; any other JSON is returned as one project, and its reader
/// reports errors.
std::vector<Json> projects_of(Json json) {
    if (json.is_object() && json.contains("shaders"))
        json = Json(std::move(json["shaders"]));
    const bool is_list =
        json.is_array() && !json.empty() && !(json[0].is_object() && json[0].contains("code"));
    if (!is_list)
        return {std::move(json)};
    return {std::make_move_iterator(json.begin()), std::make_move_iterator(json.end())};
}

Result<std::vector<Json>> projects_in(std::string_view text, const std::string& file) {
    if (!is_page(text))
        return parse_json(text, file).map(projects_of);
    std::vector<Json> projects;
    for (const std::string& project : projects_in_page(text))
        if (auto json = parse_json(project, file))
            projects.push_back(*std::move(json));
    if (projects.empty())
        return fail(error_at(
            {file},
            "there is no project in this page: ShaderToy's pages load it later. Save the content of "
            "https://www.shadertoy.com/api/v1/shaders/ID?key=KEY, or the export of a browser extension"));
    return projects;
}

Result<Json> choose(std::vector<Json> projects, std::string_view id, const std::string& file) {
    std::vector<std::string> ids;
    for (Json& project : projects) {
        ids.push_back(id_of(project));
        if (!id.empty() && ids.back() == id)
            return std::move(project);
    }
    if (projects.size() == 1 && (id.empty() || ids[0].empty()))
        return std::move(projects[0]);
    if (id.empty())
        return fail(error_at(
            {file}, fmt::format("this holds {} projects ({}): choose one with `import ID --via FILE`",
                                ids.size(), fmt::join(ids, ", "))));
    return fail(error_at({file}, fmt::format("this holds {}, but not {}", fmt::join(ids, ", "), id)));
}

/// Returns whether an address is an id alone or on ShaderToy's own site.
bool is_of_site(std::string_view address) {
    const size_t scheme = address.find("://");
    if (scheme != address.npos)
        address.remove_prefix(scheme + 3);
    const size_t slash = address.find('/');
    const std::string_view host = address.substr(0, slash);
    return slash == address.npos || host == "www.shadertoy.com" || host == "shadertoy.com";
}

} // namespace

Result<std::string> project_id(std::string_view address) {
    std::string_view last = address.substr(0, address.find_first_of("?#"));
    while (last.ends_with('/'))
        last.remove_suffix(1);
    const bool of_site = is_of_site(last);
    last.remove_prefix(last.rfind('/') + 1);
    if (of_site && is_id(last))
        return std::string(last);
    return fail(ErrorCode::usage,
                fmt::format("'{}' is not the address of a ShaderToy project: give one as in "
                            "https://www.shadertoy.com/view/XxXxXx, or its last six characters",
                            address));
}

Result<std::string> saved_project(std::string text, std::string_view id, const std::string& file) {
    if (id.empty() && !is_page(text))
        return text;
    auto projects = TRY(projects_in(text, file));
    const Json chosen = TRY(choose(std::move(projects), id, file));
    return chosen.dump(k_json_indent) + "\n";
}

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
                        fmt::format("'{}' is not UTF-8: JSON needs UTF-8, so save the file in that encoding",
                                    code_file.string()));
        }
        (*passes)[i]["code"] = std::move(value);
    }
    return json.dump(k_json_indent) + "\n";
}

namespace {

constexpr int k_buffers = 4;

/// ShaderToy's own files for the textures that Tidemark generates, as its API names them.
struct NoiseFile {
    NoiseKind kind;
    int id;
    const char* ctype;
    const char* file;
};
constexpr NoiseFile k_noise_files[] = {
    {NoiseKind::rgba_256, 30, "texture",
     "f735bee5b64ef98879dc618b016ecf7939a5756040c2cde21ccb15e69a6e1cfb.png"},
    {NoiseKind::rgba_64, 16, "texture",
     "3083c722c0c738cad0f468383167a0d246f91af2bfa373e9c5c094fb8c8413e0.png"},
    {NoiseKind::grey_256, 17, "texture",
     "0c7bf5fe9462d5bffbd11126e82908e39be3ce56220d900f633d58fb432e56f5.png"},
    {NoiseKind::grey_64, 15, "texture",
     "0a40562379b63dfb89227e6d172f39fdce9022cba76623f1054a2c83d6c0ba5d.png"},
    {NoiseKind::blue_1024, 14854, "texture",
     "cb49c003b454385aa9975733aff4571c62182ccdda480aaba9a8d250014f00ec.png"},
    {NoiseKind::bayer_8, 28, "texture",
     "85a6d68622b36995ccb98a89bbb119edf167c914660e4450d313de049320005c.png"},
    {NoiseKind::grey_volume_32, 39, "volume",
     "27012b4eadd0c3ce12498b867058e4f717ce79e10a99568cca461682d84a4b04.bin"},
    {NoiseKind::rgba_volume_32, 40, "volume",
     "aea6b99da1d53055107966b59ac5444fc8bc7b3ce2d0bbb6a4a3cbae1d97f3aa.bin"},
};

class ProjectWriter {
public:
    ProjectWriter(const Scene& scene, std::vector<Diagnostic>& warnings)
        : scene_(scene), warnings_(warnings) {}

    Result<Json> write() {
        TRY(number_buffers());
        Json passes = Json::array();
        for (const Pass& pass : scene_.passes)
            if (pass.kind == PassKind::image)
                passes.push_back(image_of(pass));
        std::string common = knobs_as_constants(scene_) + code_of(scene_.common);
        if (!common.empty()) {
            common.pop_back(); // ShaderToy adds this line end
            passes.push_back({{"inputs", Json::array()},
                              {"outputs", Json::array()},
                              {"code", common},
                              {"name", "Common"},
                              {"description", ""},
                              {"type", "common"}});
        }
        for (size_t i = 0; i < scene_.passes.size(); ++i) {
            const Pass& pass = scene_.passes[i];
            if (pass.kind == PassKind::buffer)
                passes.push_back(pass_of(pass, "buffer", buffer_name(numbers_[i]), 257 + numbers_[i]));
            else if (pass.kind == PassKind::cubemap)
                passes.push_back(pass_of(pass, "cubemap", "Cube A", 41));
            else if (pass.kind == PassKind::sound)
                passes.push_back(pass_of(pass, "sound", "Sound", 38));
        }
        const Json info = {
            {"id", ""}, {"name", valid_utf8(scene_.name())}, {"description", ""}, {"tags", Json::array()}};
        return Json{{"Shader", {{"ver", "0.1"}, {"info", info}, {"renderpass", std::move(passes)}}}};
    }

private:
    /// Gives each buffer the letter in its name; the others get the free letters, in drawing order.
    Result<void> number_buffers() {
        numbers_.assign(scene_.passes.size(), -1);
        std::array<bool, k_buffers> taken{};
        for (const bool named : {true, false})
            for (size_t i = 0; i < numbers_.size(); ++i) {
                const auto name = parse_pass_name(scene_.passes[i].name);
                if (scene_.passes[i].kind != PassKind::buffer || numbers_[i] >= 0 || (named && !name))
                    continue;
                int number = named ? name->number : 0;
                while (!named && number < k_buffers && taken[size_t(number)])
                    ++number;
                if (number == k_buffers)
                    return fail(ErrorCode::load,
                                fmt::format("'{}' has more than {} buffers, the most that ShaderToy allows",
                                            scene_.file.string(), k_buffers));
                numbers_[i] = number;
                taken[size_t(number)] = true;
            }
        return {};
    }

    void warn(const SourceLocation& where, std::string message) {
        warnings_.push_back({where.file.empty() ? SourceLocation{scene_.file.string()} : where,
                             Severity::warning, std::move(message)});
    }

    std::string code_of(const text::MappedText& text) const {
        return with_plain_knobs_as_constants(text.text(), scene_.knobs);
    }

    /// Adds `size`: ShaderToy has no such field and ignores it, but an import reads it here.
    Json image_of(const Pass& pass) {
        Json json = pass_of(pass, "image", "Image", 37);
        if (scene_.size)
            json["size"] = to_string(*scene_.size);
        return json;
    }

    Json pass_of(const Pass& pass, const char* type, const std::string& name, int output) {
        if (pass.keyboard_helpers)
            warn({}, fmt::format("'{}' uses #iKeyboard: ShaderToy has no isKeyDown and similar functions",
                                 pass.name));
        for (const HostUniform& row : k_host_uniforms)
            if (row.breaks_as_zero && (pass.text.text().find(row.name) != std::string::npos ||
                                       scene_.common.text().find(row.name) != std::string::npos))
                warn({}, fmt::format("'{}' uses {}: ShaderToy has no such uniform; there it is all zeros",
                                     pass.name, row.name));
        Json inputs = Json::array();
        for (size_t i = 0; i < pass.channels.size(); ++i) {
            const std::string channel = fmt::format("iChannel{}", i);
            const bool mentioned = pass.text.text().find(channel) != std::string::npos ||
                                   scene_.common.text().find(channel) != std::string::npos;
            if (mentioned && i >= size_t(k_site_channel_count))
                warn(pass.channels[i].where,
                     fmt::format("'{}' reads {}: ShaderToy has four channels", pass.name, channel));
            else if (mentioned && !traits_of(pass.channels[i].input).site_type.empty())
                inputs.push_back(input_of(pass.channels[i], int(i)));
        }
        return {{"inputs", std::move(inputs)}, {"outputs", Json::array({{{"id", output}, {"channel", 0}}})},
                {"code", code_of(pass.text)},  {"name", name},
                {"description", ""},           {"type", type}};
    }

    Json input_of(const Channel& channel, int number) {
        const Sampling& sampling = channel.sampling;
        Json input = source_of(channel);
        input["channel"] = number;
        input["sampler"] = {{"filter", sampling.mipmaps != Mipmaps::none     ? "mipmap"
                                       : sampling.magnify == Filter::nearest ? "nearest"
                                                                             : "linear"},
                            {"wrap", sampling.wrap == Wrap::clamp ? "clamp" : "repeat"},
                            {"vflip", sampling.vflip ? "true" : "false"},
                            {"srgb", "false"},
                            {"internal", "byte"}};
        input["published"] = 1;
        return input;
    }

    Json source_of(const Channel& channel) {
        return std::visit(
            Overloaded{[&](const PassOutput& output) { return output_of(output.pass); },
                       [&](const Noise& noise) { return noise_of(noise, channel); },
                       [](const Keyboard&) -> Json {
                           return {{"id", 33}, {"src", "/presets/tex00.jpg"}, {"ctype", "keyboard"}};
                       },
                       [&](const Music& music) { return live_or_file(music, 32, "mic", channel); },
                       [&](const Video& video) { return live_or_file(video, 31, "webcam", channel); },
                       [&](const auto&) { return own_file(channel); }},
            channel.input);
    }

    /// Returns the live microphone or webcam for an input without a file, since ShaderToy uses those.
    template <class Played>
    Json live_or_file(const Played& input, int id, std::string_view type, const Channel& channel) {
        if (!input.file.empty())
            return own_file(channel);
        return {{"id", id}, {"src", fmt::format("/presets/{}.png", type)}, {"ctype", type}};
    }

    Json noise_of(const Noise& noise, const Channel& channel) {
        for (const NoiseFile& file : k_noise_files)
            if (file.kind == noise.kind)
                return {
                    {"id", file.id}, {"src", fmt::format("/media/a/{}", file.file)}, {"ctype", file.ctype}};
        return own_file(channel);
    }

    Json output_of(size_t pass) const {
        if (scene_.passes[pass].kind == PassKind::cubemap)
            return {{"id", 41}, {"src", "/media/previz/cubemap00.png"}, {"ctype", "cubemap"}};
        return {{"id", 257 + numbers_[pass]},
                {"src", fmt::format("/media/previz/buffer0{}.png", numbers_[pass])},
                {"ctype", "buffer"}};
    }

    /// Returns a file of the scene's own, with a warning: ShaderToy does not have it.
    Json own_file(const Channel& channel) {
        const auto files = input_files(channel.input);
        const std::string source =
            files.empty() ? std::string(traits_of(channel.input).name) : relative(files.front());
        warn(channel.where, fmt::format("ShaderToy has no '{}': choose another input there", source));
        return {{"id", 0}, {"src", source}, {"ctype", traits_of(channel.input).site_type}};
    }

    std::string relative(const std::filesystem::path& file) const {
        std::error_code ignored;
        const bool folder = std::filesystem::is_directory(scene_.file, ignored);
        return file.lexically_proximate(folder ? scene_.file : scene_.file.parent_path()).string();
    }

    const Scene& scene_;
    std::vector<Diagnostic>& warnings_;
    std::vector<int> numbers_; ///< for each pass that is a buffer; -1: no buffer
};

} // namespace

std::string knobs_as_constants(const Scene& scene) {
    std::string text;
    for (const Knob& knob : scene.knobs) {
        if (knob.plain)
            continue;
        const std::string_view type = info(knob.type).glsl_name;
        text += fmt::format("const {} {} = {};\n", type, knob.name, as_glsl(knob, type));
    }
    return text;
}

Result<std::string> make_project(const Scene& scene, std::vector<Diagnostic>& warnings) {
    auto json = TRY(ProjectWriter(scene, warnings).write());
    try {
        return json.dump(k_json_indent) + "\n";
    } catch (const Json::type_error&) { // JSON must be Unicode
        return fail(
            ErrorCode::load,
            fmt::format(
                "'{}' has a text that is not UTF-8: JSON needs UTF-8, so save the text in that encoding",
                scene.file.string()));
    }
}

} // namespace tidemark::scene
