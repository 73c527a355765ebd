#include "host/presets.hpp"

#include "base/encoding.hpp"
#include "base/file.hpp"
#include "host/json.hpp"
#include "host/overlay_model.hpp"
#include "media/picture_codecs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace tidemark::host {
namespace {

namespace fs = std::filesystem;

constexpr const char* k_version_field = "tidemark_presets";
constexpr int k_version_of_presets = 1;
constexpr std::string_view k_picture_prefix = "data:image/png;base64,";
/// The largest side of a thumbnail that is read from a file.
constexpr int k_largest_thumbnail = 512;
/// The fields of a preset; all others are kept as they are.
constexpr std::array<std::string_view, 8> k_fields{"name",  "set",  "define", "camera",
                                                   "mouse", "size", "time",   "thumbnail"};

/// Returns the bytes of base64 text; nothing for anything else.
std::optional<std::string> bytes_of_base64(std::string_view text) {
    std::string bytes;
    unsigned group = 0;
    int bits = 0;
    while (text.ends_with('='))
        text.remove_suffix(1);
    for (const char digit : text) {
        const int value = digit >= 'A' && digit <= 'Z'   ? digit - 'A'
                          : digit >= 'a' && digit <= 'z' ? digit - 'a' + 26
                          : digit >= '0' && digit <= '9' ? digit - '0' + 52
                          : digit == '+'                 ? 62
                          : digit == '/'                 ? 63
                                                         : -1;
        if (value < 0)
            return std::nullopt;
        group = (group << 6 | unsigned(value)) & 0xFFFFFF;
        bits += 6;
        if (bits >= 8)
            bytes += char(group >> (bits -= 8) & 0xFF);
    }
    return bytes;
}

/// Returns the side that is stored at that place of a PNG's header.
int side_at(std::string_view png, size_t place) {
    unsigned side = 0;
    for (size_t i = 0; i < 4; ++i)
        side = side << 8 | static_cast<unsigned char>(png[place + i]);
    return side <= unsigned(k_largest_thumbnail) ? int(side) : 0;
}

/// Returns the thumbnail; without pixels if the text is not one.
image::Image picture_of(std::string_view text) {
    constexpr std::string_view k_signature = "\x89PNG\r\n\x1a\n";
    constexpr size_t k_width = 16, k_height = 20, k_header = 33;
    if (!text.starts_with(k_picture_prefix))
        return {};
    const auto png = bytes_of_base64(text.substr(k_picture_prefix.size()));
    if (!png || png->size() < k_header || !png->starts_with(k_signature) || side_at(*png, k_width) == 0 ||
        side_at(*png, k_height) == 0)
        return {};
    auto picture = image::decode_png(std::as_bytes(std::span(*png)));
    const bool usable = picture && picture->channels == 3 && picture->type == image::SampleType::u8;
    return usable ? *std::move(picture) : image::Image{};
}

std::string text_of(const image::Image& picture) {
    const auto png = image::encode_png(
        {image::FileFormat::png, image::SampleDepth::u8, picture.extent, 3, picture.bytes, {}});
    if (!png)
        return "";
    return std::string(k_picture_prefix) + base64({reinterpret_cast<const char*>(png->data()), png->size()});
}

/// Returns the value of an option that recreates the state; empty if the state does not need it.
std::string word_of(const render::FrameState& state, std::string_view option) {
    const std::vector<std::string> words = option_words(state);
    const auto found = std::ranges::find(words, option);
    return found == words.end() ? "" : *(found + 1);
}

/// Returns the settings of a JSON object as `NAME=VALUE`.
std::vector<std::string> settings_in(const Json& json, const char* field) {
    std::vector<std::string> settings;
    const Json object = json.value(field, Json::object());
    for (const auto& [name, value] : object.items())
        settings.push_back(name + "=" + (value.is_string() ? value.get<std::string>() : dump(value)));
    return settings;
}

/// Returns the JSON without the fields that `known` names.
std::string others_in(const Json& json, std::span<const std::string_view> known) {
    Json others = Json::object();
    for (const auto& [name, value] : json.items())
        if (std::ranges::find(known, name) == known.end())
            others[name] = value;
    return others.empty() ? "" : dump(others);
}

std::optional<double> number_in(const Json& json, const char* field) {
    const auto found = json.find(field);
    return found != json.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

std::string names_of(const std::vector<Preset>& presets) {
    std::vector<std::string> names;
    for (const Preset& preset : presets)
        names.push_back(fmt::format("'{}'", preset.name));
    return fmt::format("{}", fmt::join(names, ", "));
}

bool has_name(const std::vector<Preset>& presets, const std::string& name) {
    return std::ranges::find(presets, name, &Preset::name) != presets.end();
}

/// Returns the preset of that name, or else of that number, from 1.
const Preset* find_preset(const std::vector<Preset>& presets, const std::string& name) {
    const auto named = std::ranges::find(presets, name, &Preset::name);
    if (named != presets.end())
        return &*named;
    const auto number = number_from<size_t>(name);
    return number && *number >= 1 && *number <= presets.size() ? &presets[*number - 1] : nullptr;
}

/// Returns the size of the picture that the command will draw, as far as the mouse needs it.
Extent drawn_size(Command command, const fs::path& scene) {
    if (command.has_option("--size"))
        if (const auto typed = command.option("--size").texts(); !typed.empty())
            return parse_size(typed.back()).value_or(render::FrameState().extent);
    const auto loaded = scene::load_scene(scene);
    return loaded && loaded->size ? *loaded->size : render::FrameState().extent;
}

/// Gives an option that may stand once, unless the user gives it or one that excludes it.
void give(Command command, const char* name, const std::string& value,
          std::initializer_list<const char*> unless = {}) {
    const auto given = [&](const char* option) {
        return command.has_option(option) && !command.option(option).texts().empty();
    };
    if (!value.empty() && command.has_option(name) && !given(name) && std::ranges::none_of(unless, given))
        command.option(name).add_text(value);
}

/// Gives the settings of names that the user does not set.
void give_settings(Command command, const char* option, const std::vector<std::string>& settings) {
    if (!command.has_option(option))
        return;
    const std::vector<std::string> typed = command.option(option).texts();
    for (const std::string& setting : settings) {
        const std::string begin = setting.substr(0, setting.find('=') + 1);
        if (std::ranges::none_of(typed, [&](const std::string& text) { return text.starts_with(begin); }))
            command.option(option).add_text(setting);
    }
}

/// Gives the options of a preset to a command. Returns what is wrong.
std::string give_preset(Command command, const fs::path& scene, const std::string& name) {
    if (scene.empty())
        return fmt::format("name the scene, as in `tidemark {} SCENE --preset {}`", command.name(), name);
    if (scene == "-")
        return "a scene from standard input has no presets";
    const auto file = PresetFile::read(scene);
    if (!file)
        return file.error().message;
    const Preset* const preset = find_preset(file->presets(), name);
    if (!preset && file->presets().empty())
        return fmt::format("'{}' holds no presets: press K in the scene's window to keep one",
                           file->path().string());
    if (!preset)
        return fmt::format("'{}' has no preset '{}', but {}", file->path().string(), name,
                           names_of(file->presets()));
    std::vector<std::string> sets;
    for (const scene::KnobSetting& knob : preset->knobs)
        sets.push_back(knob.name + "=" + scene::to_string(knob.value));
    give_settings(command, "--set", sets);
    give_settings(command, "--define", preset->defines);
    if (command.has_option("--trace") && command.option("--trace").texts().empty())
        return ""; // `check` chooses its own moments
    render::FrameState state;
    state.camera = preset->camera;
    give(command, "--camera", word_of(state, "--camera"));
    if (preset->mouse != render::Mouse()) {
        state.mouse = preset->mouse;
        state.mouse.stretch(preset->extent, drawn_size(command, scene));
        give(command, "--mouse", word_of(state, "--mouse"), {"--input"});
    }
    give(command, "--time", fmt::format("{}", preset->seconds),
         {"--frame", "--frames", "--from", "--to", "--duration", "--input", "--loop"});
    return "";
}

} // namespace

std::string label_of(const Preset& preset) {
    std::string label = fmt::format("{:.3f} s", preset.seconds);
    for (const scene::KnobSetting& knob : preset.knobs)
        label += fmt::format(", {} = {}", knob.name, scene::to_string(knob.value));
    return label;
}

image::Image thumbnail_of(const image::Image& picture, Extent most) {
    const Extent from = picture.extent;
    const double shrink = std::max({1.0, double(from.width) / most.width, double(from.height) / most.height});
    const Extent size{std::max(1, int(from.width / shrink)), std::max(1, int(from.height / shrink))};
    image::Image small(size, 3, image::SampleType::u8);
    if (picture.type != image::SampleType::u8 || picture.channels < 3)
        return {};
    const auto channels = size_t(picture.channels);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const int left = x * from.width / size.width, right = (x + 1) * from.width / size.width;
            const int low = y * from.height / size.height, high = (y + 1) * from.height / size.height;
            std::array<unsigned, 3> sums{};
            for (int row = low; row < high; ++row)
                for (int column = left; column < right; ++column)
                    for (size_t i = 0; i < 3; ++i)
                        sums[i] +=
                            picture.u8()[(size_t(row) * size_t(from.width) + size_t(column)) * channels + i];
            const auto count = unsigned(std::max((right - left) * (high - low), 1));
            for (size_t i = 0; i < 3; ++i)
                small.u8()[(size_t(y) * size_t(size.width) + size_t(x)) * 3 + i] =
                    uint8_t((sums[i] + count / 2) / count);
        }
    return small;
}

fs::path presets_file(const fs::path& scene) {
    if (scene.empty() || scene == "-")
        return {};
    if (scene.filename() == scene::k_project_file)
        return scene.parent_path() / "presets.json";
    return file_beside(scene, "presets.json");
}

Json to_json(const Preset& preset) {
    Json json{{"name", preset.name}};
    for (const scene::KnobSetting& knob : preset.knobs)
        json["set"][knob.name] = scene::to_string(knob.value);
    for (const std::string& define : preset.defines)
        json["define"][define.substr(0, define.find('='))] = define.substr(define.find('=') + 1);
    json["camera"] = to_string(preset.camera);
    if (preset.mouse != render::Mouse()) {
        render::FrameState state;
        state.mouse = preset.mouse;
        json["mouse"] = word_of(state, "--mouse");
        json["size"] = scene::to_string(preset.extent);
    }
    json["time"] = preset.seconds;
    if (preset.picture.extent.pixels() > 0)
        json["thumbnail"] = text_of(preset.picture);
    if (!preset.others.empty())
        json.update(parse_json(preset.others));
    return json;
}

Result<Preset> preset_of(const Json& json) {
    try {
        Preset preset;
        preset.name = json.at("name").get<std::string>();
        for (const std::string& text : settings_in(json, "set")) {
            const auto [name, value] = TRY(scene::split_setting(text, "set"));
            preset.knobs.push_back(TRY(scene::parse_knob_setting(name, value)));
        }
        preset.defines = settings_in(json, "define");
        if (json.contains("camera"))
            preset.camera = TRY(render::parse_camera(json["camera"].get<std::string>()));
        if (json.contains("mouse"))
            preset.mouse = TRY(parse_mouse(json["mouse"].get<std::string>()));
        if (json.contains("size"))
            preset.extent = TRY(parse_size(json["size"].get<std::string>()));
        preset.seconds = number_in(json, "time").value_or(0);
        preset.picture = picture_of(json.value("thumbnail", ""));
        preset.others = others_in(json, k_fields);
        return preset;
    } catch (const Json::exception&) {
        return fail(ErrorCode::load, "a preset needs a name, and its other fields as texts and numbers");
    }
}

Preset preset_of(const Moment& moment, std::string name) {
    const render::FrameState& state = moment.sequence.state;
    return {.name = std::move(name),
            .knobs = state.knobs,
            .defines = moment.scene.defines,
            .camera = state.camera,
            .mouse = state.mouse,
            .extent = state.extent,
            .seconds = state.seconds()};
}

Result<PresetFile> PresetFile::read(const fs::path& scene) {
    PresetFile file(presets_file(scene));
    TRY(file.load());
    return file;
}

Result<void> PresetFile::load() {
    text_.clear();
    others_.clear();
    presets_.clear();
    std::error_code ignored;
    if (path_.empty() || !exists(fs::symlink_status(path_, ignored)))
        return {};
    const std::string text = TRY(read_text_file(path_));
    const auto refuse = [&](std::string_view why) {
        return fail(ErrorCode::load, fmt::format("'{}' is not a file of presets: {}", path_.string(), why));
    };
    const Json json = parse_or_discard(text);
    if (!json.is_object() || !json.contains(k_version_field) || !json.contains("presets") ||
        !json["presets"].is_array())
        return refuse("rename it, so that presets can be kept in a file of that name");
    if (json[k_version_field] != k_version_of_presets)
        return refuse("it is from a later version of Tidemark");
    for (const Json& each : json["presets"]) {
        auto preset = preset_of(each);
        if (!preset)
            return refuse(fmt::format("its preset {}: {}", presets_.size() + 1, preset.error().message));
        presets_.push_back(*std::move(preset));
    }
    others_ = others_in(json, std::array<std::string_view, 2>{k_version_field, "presets"});
    text_ = text;
    return {};
}

Result<void> PresetFile::write(std::vector<Preset> presets) {
    if (path_.empty())
        return fail(ErrorCode::write, "a scene from standard input has no file beside it");
    PresetFile now(path_);
    if (auto loaded = now.load(); !loaded)
        return fail(ErrorCode::write, loaded.error().message);
    for (const Preset& other : now.presets_)
        if (!has_name(presets_, other.name) && !has_name(presets, other.name))
            presets.push_back(other);
    Json json{{k_version_field, k_version_of_presets}};
    if (!now.others_.empty())
        json.update(parse_json(now.others_));
    json["presets"] = Json::array();
    for (const Preset& preset : presets)
        json["presets"].push_back(to_json(preset));
    std::string text = dump(json, 2) + "\n";
    if (now.text_.empty())
        TRY(write_file(OutputPath(path_), text));
    else
        TRY(replace_text(OutputPath(path_), now.text_, text));
    text_ = std::move(text);
    others_ = now.others_;
    presets_ = std::move(presets);
    return {};
}

void add_preset_option(Command command, const fs::path& scene) {
    command
        .add_option(
            "--preset", [](const std::string&) {},
            "Knobs, definitions, camera, mouse and time of a preset of that name or number, kept in the "
            "scene's window; other options override it")
        .type_name("NAME")
        .needs("SCENE")
        .check([command, &scene](const std::string& name) { return give_preset(command, scene, name); });
}

Morph::Morph(const std::vector<scene::Knob>& knobs, const render::OrbitCamera& camera, const Preset& to,
             double begun, double seconds)
    : from_(camera), to_(to.camera), begun_(begun), seconds_(seconds) {
    const std::vector<scene::KnobSetting> settings = settings_of(to, knobs);
    for (const scene::Knob& knob : knobs)
        if (const auto wanted = value_after(knob, settings); wanted != knob.value)
            turns_.push_back({knob, wanted});
}

/// Returns the share of the way, which begins and ends slowly.
double Morph::share(double now) const {
    const double part = seconds_ > 0 ? std::clamp((now - begun_) / seconds_, 0.0, 1.0) : 1.0;
    return part * part * (3 - 2 * part);
}

std::vector<scene::KnobSetting> Morph::knobs(double now) const {
    const double part = share(now);
    std::vector<scene::KnobSetting> settings;
    for (const Turn& turn : turns_) {
        scene::KnobValue value = turn.to;
        for (size_t i = 0; part < 1 && i < value.size(); ++i) {
            value[i] = std::lerp(turn.knob.value[i], turn.to[i], part);
            if (info(turn.knob.type).whole)
                value[i] = std::round(value[i]);
        }
        settings.push_back(setting_of(turn.knob, value));
    }
    return settings;
}

/// Turns the shorter way round, and moves away or closer by a constant factor in each step.
render::OrbitCamera Morph::camera(double now) const {
    constexpr double k_circle = 360;
    const double part = share(now);
    if (part >= 1 || from_ == to_)
        return to_;
    const double turn = std::remainder(to_.azimuth - from_.azimuth, k_circle);
    render::OrbitCamera camera = from_;
    camera.azimuth = std::fmod(from_.azimuth + part * turn + k_circle, k_circle);
    camera.elevation = std::lerp(from_.elevation, to_.elevation, part);
    camera.distance = from_.distance * std::pow(to_.distance / from_.distance, part);
    camera.target = from_.target + part * (to_.target - from_.target);
    return camera;
}

std::vector<scene::KnobSetting> settings_of(const Preset& preset, const std::vector<scene::Knob>& knobs) {
    std::vector<scene::KnobSetting> settings;
    for (const scene::Knob& knob : knobs) {
        const auto held = std::ranges::find(preset.knobs, knob.name, &scene::KnobSetting::name);
        if (held != preset.knobs.end())
            settings.push_back(*held);
        else
            settings.push_back({knob.name, {}});
    }
    return settings;
}

} // namespace tidemark::host
