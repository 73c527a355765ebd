#include "scene/project.hpp"

#include "base/try.hpp"
#include "scene/json_text.hpp"
#include "scene/pass_names.hpp"

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
            return refuse("renderpass is no list of passes");
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
            return refuse(fmt::format("pass {} is no object", number));
        ProjectPass pass;
        pass.name = as_text(json, "name");
        const std::string called =
            pass.name.empty() ? fmt::format("pass {}", number) : fmt::format("the pass '{}'", pass.name);
        const auto kind = kind_of(json, pass.name);
        if (!kind)
            return refuse(fmt::format("{} is of the unknown type '{}': ShaderToy has image, buffer, common, "
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
                return refuse(
                    fmt::format("the code of {} stands in the file '{}': so it may in the scene.json "
                                "of a folder, as `import` makes one; elsewhere it is a string",
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
                 fmt::format("{} has an input of channel '{}': left out, for there are 0 to 3", called,
                             channel)});
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

} // namespace tidemark::scene
