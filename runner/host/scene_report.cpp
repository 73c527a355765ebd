#include "host/scene_report.hpp"

#include "base/encoding.hpp"
#include "host/console.hpp"
#include "host/json.hpp"
#include "media/image.hpp"
#include "media/sound_file.hpp"
#include "render/gl_program.hpp"
#include "render/sound_renderer.hpp"
#include "scene/host_uniforms.hpp"
#include "shader/definitions.hpp"
#include "shader/driver_log.hpp"
#include "shader/pass_reading.hpp"
#include "shader/portability.hpp"
#include "shader/shader_source.hpp"
#include "shader/specialise.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace tidemark::host {
namespace {

std::vector<double> components_of(const scene::Knob& knob, const scene::KnobValue& value) {
    return {value.begin(), value.begin() + scene::info(knob.type).components};
}

/// Returns true if the input was assigned. Otherwise it is the default noise, which is present in case a
/// program reads it.
bool is_chosen(const scene::Channel& channel) {
    return !channel.where.file.empty() || !traits_of(channel.input).default_input;
}

/// Replaces each run of white space by one space, and truncates after 60 bytes.
std::string in_short(std::string_view text) {
    constexpr size_t k_longest = 60;
    std::string line;
    for (const char c : text)
        if (c != ' ' && c != '\n' && c != '\t')
            line += c;
        else if (!line.ends_with(' '))
            line += ' ';
    return line.size() <= k_longest ? line : line.substr(0, k_longest) + "…";
}

/// Returns the host uniforms of a pass that makes a picture.
std::vector<std::string_view> host_uniforms() {
    std::vector<std::string_view> names;
    for (const scene::HostUniform& row : scene::k_host_uniforms)
        if (row.image && !row.name.empty())
            names.push_back(row.name);
    return names;
}

void add_list(std::vector<std::string>& left_out, std::string_view what,
              const std::vector<std::string>& names) {
    if (!names.empty())
        left_out.push_back(fmt::format("{}: {}", what, fmt::join(names, ", ")));
}

/// Collects the facts of all drawn passes.
class Collector {
public:
    explicit Collector(const render::Renderer& renderer) : renderer_(renderer), scene_(renderer.scene()) {}

    SceneFacts collect() {
        for (const render::PlannedPass& planned : renderer_.plan().passes) {
            for (const gl::Uniform& uniform : renderer_.program(planned.pass).reflection().uniforms)
                if (!has(uniform.name)) {
                    facts_.uniforms.push_back(uniform.name);
                    note_other_name(uniform.name, renderer_.names_of(planned.pass).other_hosts);
                }
            facts_.passes.push_back({planned.pass, planned.channels});
        }
        add_list(facts_.left_out, "passes", passes_not_drawn());
        add_list(facts_.left_out, "uniforms", unused(host_uniforms()));
        std::vector<std::string> knobs;
        for (const scene::Knob& knob : scene_.knobs)
            knobs.push_back(knob.name);
        add_list(facts_.left_out, "knobs", unused(knobs));
        add_list(facts_.left_out, "channels", channels_not_read());
        add_list(facts_.left_out, "second textures", single_buffers());
        if (!reads_noise())
            facts_.left_out.emplace_back("noise texture");
        return std::move(facts_);
    }

private:
    void note_other_name(const std::string& name, bool other_hosts) {
        const auto* const row = scene::find_host_uniform(name, other_hosts);
        if (row && !scene::find_host_uniform(name))
            facts_.other_names.emplace_back(name, row->name.empty() ? row->meaning : row->name);
    }

    bool has(std::string_view uniform) const {
        return std::find(facts_.uniforms.begin(), facts_.uniforms.end(), uniform) != facts_.uniforms.end();
    }

    template <class Names>
    std::vector<std::string> unused(const Names& names) const {
        std::vector<std::string> left;
        for (const auto& name : names)
            if (!has(name))
                left.emplace_back(name);
        return left;
    }

    std::vector<std::string> passes_not_drawn() const {
        std::vector<std::string> names;
        for (size_t i = 0; i < scene_.passes.size(); ++i)
            if (!renderer_.plan().find(i))
                names.push_back(scene_.passes[i].name);
        return names;
    }

    /// With several passes, only channels that the scene assigned count as left out.
    std::vector<std::string> channels_not_read() const {
        std::vector<std::string> names;
        const bool several = scene_.passes.size() > 1;
        for (const PassFacts& pass : facts_.passes)
            for (int i = 0; i < scene::k_channel_count; ++i) {
                const scene::Channel& channel = scene_.passes[pass.pass].channels[size_t(i)];
                const bool read =
                    std::find(pass.channels.begin(), pass.channels.end(), i) != pass.channels.end();
                const bool named = !channel.where.file.empty();
                if (read || (several && !traits_of(channel.input).loaded) ||
                    (i >= scene::k_site_channel_count && !named))
                    continue;
                names.push_back(several ? fmt::format("iChannel{} of {}", i, scene_.passes[pass.pass].name)
                                        : fmt::format("iChannel{}", i));
            }
        return names;
    }

    std::vector<std::string> single_buffers() const {
        std::vector<std::string> names;
        for (const PassFacts& pass : facts_.passes)
            if (scene_.passes[pass.pass].kind != scene::PassKind::image &&
                !renderer_.plan().targets[pass.pass].two_textures)
                names.push_back(scene_.passes[pass.pass].name);
        return names;
    }

    /// True if a drawn pass reads the noise texture, the input of channels that were not assigned.
    bool reads_noise() const {
        for (const PassFacts& pass : facts_.passes)
            for (const int i : pass.channels)
                if (const auto& traits = traits_of(scene_.passes[pass.pass].channels[size_t(i)].input);
                    traits.default_input && traits.loaded)
                    return true;
        return false;
    }

    const render::Renderer& renderer_;
    const scene::Scene& scene_;
    SceneFacts facts_;
};

template <class Use>
void each_hash(const render::Renderer& renderer, Use use) {
    for (const render::PlannedPass& planned : renderer.plan().passes)
        for (const glsl::KeptHash& hash : renderer.kept_hashes(planned.pass))
            use(renderer.scene().passes[planned.pass], hash);
}

} // namespace

std::string describe(const scene::Scene& scene, const scene::Channel& channel) {
    if (const size_t* pass = source_pass(channel.input))
        return scene.passes[*pass].name;
    const auto files = input_files(channel.input);
    if (files.empty())
        return std::string(traits_of(channel.input).name);
    std::string names;
    for (const std::filesystem::path& file : files) // a cube may have six
        names += (names.empty() ? "" : ", ") + file.string();
    return names;
}

bool may_feed_back(const scene::Scene& scene) {
    return std::ranges::any_of(scene.passes, [](const scene::Pass& pass) {
        return pass.kind == scene::PassKind::buffer || pass.kind == scene::PassKind::cubemap;
    });
}

Json files_of(const scene::Scene& scene) {
    Json files = Json::array();
    for (const auto& file : scene.files)
        files.push_back(file.string());
    return files;
}

Json sounds_of(const scene::Scene& scene) {
    Json sounds = Json::array();
    for (const render::HeardChannel& channel : render::heard_channels(scene)) {
        Json& json = sounds.emplace_back(Json{{"channel", channel.name}, {"file", channel.file.string()}});
        const auto sound = render::read_sound_of(channel);
        if (!sound)
            json["error"] = sound.error().message;
        else if (*sound)
            json.update({{"seconds", (*sound)->data.duration()},
                         {"rate", (*sound)->data.rate},
                         {"channels", (*sound)->data.channels}});
        else
            json["seconds"] = 0;
    }
    return sounds;
}

std::string sound_lines(const scene::Scene& scene) {
    std::string text;
    for (const Json& json : sounds_of(scene)) {
        const std::string about = json.contains("error") ? json["error"].get<std::string>()
                                  : json.contains("channels")
                                      ? fmt::format("{:.3f} s, {}", json["seconds"].get<double>(),
                                                    sound::rate_words(json["rate"], json["channels"]))
                                      : "no audio track";
        text += fmt::format("  sound     {}: {}\n", json["channel"].get<std::string>(), about);
    }
    return text;
}

Json knobs_of(const scene::Scene& scene) {
    Json knobs = Json::array();
    for (const scene::Knob& knob : scene.knobs) {
        Json& json = knobs.emplace_back(Json{{"name", knob.name},
                                             {"type", scene::info(knob.type).directive_name},
                                             {"value", components_of(knob, knob.value)}});
        if (knob.range) {
            json["low"] = components_of(knob, knob.range->low);
            json["high"] = components_of(knob, knob.range->high);
        }
    }
    return knobs;
}

std::string knob_lines(const scene::Scene& scene) {
    std::string text;
    for (const scene::Knob& knob : scene.knobs) {
        text += fmt::format("  knob      {} {} = {}", scene::info(knob.type).directive_name, knob.name,
                            scene::to_string(knob));
        if (knob.range)
            text += fmt::format(" in {{ {}, {} }}", scene::to_string(knob, knob.range->low),
                                scene::to_string(knob, knob.range->high));
        text += '\n';
    }
    return text;
}

Json definitions_of(const scene::Scene& scene) {
    Json definitions = Json::object();
    for (const glsl::NamedText& definition : glsl::definitions_of(scene))
        definitions[definition.name] = definition.text;
    return definitions;
}

std::string definition_lines(const scene::Scene& scene) {
    std::string text;
    for (const glsl::NamedText& definition : glsl::definitions_of(scene))
        if (!definition.text.empty())
            text += fmt::format("  define    {} = {}\n", definition.name, in_short(definition.text));
    return text;
}

Json what_files_say(const scene::Scene& scene) {
    Json json = {{"tidemark", k_version}, {"scene", scene.file.string()}, {"files", files_of(scene)}};
    json["passes"] = Json::array();
    for (const scene::Pass& pass : scene.passes) {
        Json channels = Json::object();
        for (size_t i = 0; i < pass.channels.size(); ++i)
            if (is_chosen(pass.channels[i]))
                channels[fmt::format("iChannel{}", i)] = describe(scene, pass.channels[i]);
        json["passes"].push_back({{"name", pass.name}, {"channels", channels}});
    }
    if (scene.size)
        json["size"] = {scene.size->width, scene.size->height};
    json["sounds"] = sounds_of(scene);
    json["knobs"] = knobs_of(scene);
    json["definitions"] = definitions_of(scene);
    return json;
}

std::string lines_of_files(const scene::Scene& scene) {
    std::string text = scene.file.string() + '\n';
    for (const auto& file : scene.files)
        text += fmt::format("  file      {}\n", file.string());
    for (const scene::Pass& pass : scene.passes) {
        text += fmt::format("  pass      {}\n", pass.name);
        for (size_t i = 0; i < pass.channels.size(); ++i)
            if (is_chosen(pass.channels[i]))
                text += fmt::format("  iChannel{} {}\n", i, describe(scene, pass.channels[i]));
    }
    return text + sound_lines(scene) + knob_lines(scene) + definition_lines(scene);
}

SceneFacts facts_of(const render::Renderer& renderer) {
    return Collector(renderer).collect();
}

glsl::LeftOut left_out_of(const render::Renderer& renderer, size_t pass, glsl::Specialise how) {
    const scene::Scene& scene = renderer.scene();
    if (renderer.precision() != glsl::Precision::single)
        return renderer.left_out(pass);
    return glsl::specialise(glsl::assemble(scene, scene.passes[pass], renderer.dialect(pass)), scene.knobs,
                            how)
        .left_out;
}

std::string name_of(glsl::Precision precision) {
    return precision == glsl::Precision::single ? "single" : "double";
}

void add_precision(nlohmann::ordered_json& report, const render::Renderer& renderer) {
    report["precision"] = name_of(renderer.precision());
    if (renderer.precision() == glsl::Precision::single)
        return;
    auto& hashes = report["float_hashes"] = nlohmann::ordered_json::array();
    each_hash(renderer, [&](const scene::Pass& pass, const glsl::KeptHash& hash) {
        hashes.push_back({{"pass", pass.name},
                          {"function", hash.function},
                          {"file", hash.where.file},
                          {"line", hash.where.line},
                          {"kind", glsl::to_string(hash.kind)}});
    });
}

std::string precision_lines(const render::Renderer& renderer) {
    if (renderer.precision() == glsl::Precision::single)
        return {};
    std::string text = "  precision double\n";
    each_hash(renderer, [&](const scene::Pass&, const glsl::KeptHash& hash) {
        text += fmt::format("  float     {} hash {}, {}:{}\n", glsl::to_string(hash.kind), hash.function,
                            hash.where.file, hash.where.line);
    });
    return text;
}

size_t count_not_finite(const render::Renderer& renderer, image::Image& picture) {
    return count_not_finite(renderer, std::span(&picture, 1), {});
}

size_t count_not_finite(const render::Renderer& renderer, std::span<image::Image> pictures,
                        const std::optional<Rectangle>& crop) {
    const scene::PassKind shown = renderer.shown_pass().kind;
    size_t count = 0;
    if (shown == scene::PassKind::image || pictures.front().type == image::SampleType::f32) {
        for (image::Image& picture : pictures)
            count += image::take_non_finite(picture);
        return count;
    }
    const bool cube = shown == scene::PassKind::cubemap;
    for (int face = 0; face < (cube ? 6 : 1); ++face) {
        image::Image floats = renderer.read_floats(renderer.shown_index(), face);
        if (crop && !cube)
            floats = image::cropped(std::move(floats), *crop);
        count += image::take_non_finite(floats);
    }
    return count;
}

std::string pixels_are(size_t count, const std::string& when) {
    return fmt::format("{} pixel{} {} {}", count, count > 1 ? "s" : "", when, count > 1 ? "are" : "is");
}

std::vector<std::string> trace_words(const SceneRequest& scene, const FrameSequence& sequence,
                                     const render::FrameState& state) {
    std::vector<std::string> words{"tidemark", "check", "--trace", file_word(scene.path)};
    const std::vector<std::string> options = option_words(scene, sequence.input_file, state);
    words.insert(words.end(), options.begin(), options.end());
    return words;
}

std::string trace_command(const SceneRequest& scene, const FrameSequence& sequence,
                          const render::FrameState& state) {
    return shell_words(trace_words(scene, sequence, state));
}

void add_site_refusals(const scene::Scene& scene, std::vector<Diagnostic>& found,
                       const std::function<void(const std::string& pass)>& compiling) {
    const auto is_known = [&found](const SourceLocation& where) {
        return std::ranges::any_of(found, [&](const Diagnostic& known) {
            return known.where.line > 0 && known.where.file == where.file && known.where.line == where.line;
        });
    };
    for (const scene::Pass& pass : scene.passes) {
        const glsl::PassReading reading(scene, pass);
        const text::MappedText source = reading.site_source();
        if (compiling)
            compiling(pass.name);
        const auto linked = gl::Program::link(glsl::vertex_shader(glsl::Version::es_300), source.text());
        if (linked)
            continue;
        auto refusals = glsl::parse_driver_log(linked.error(), source);
        std::erase_if(refusals, [&](const glsl::DriverMessage& refusal) {
            return refusal.follows || glsl::is_taken_by_the_site(reading, refusal.diagnostic.message) ||
                   refusal.diagnostic.severity != Severity::error || is_known(refusal.diagnostic.where);
        });
        for (auto& [refusal, follows] : refusals) {
            if (refusal.where.file.empty())
                refusal.message = fmt::format("{}: {}", pass.name, refusal.message);
            found.push_back(std::move(refusal));
        }
    }
}

} // namespace tidemark::host
