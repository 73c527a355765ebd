#include "host/moment.hpp"

#include "base/encoding.hpp"
#include "host/console.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace tidemark::host {
namespace {

/// The largest width or height of a picture, in pixels.
constexpr int k_largest_side = 1 << 20;

template <class T>
void put_unless_default(Json& json, const char* name, const T& value) {
    if (value != T{})
        json[name] = value;
}

template <class T>
void take(const Json& json, const char* name, T& value) {
    if (const auto found = json.find(name); found != json.end())
        found->get_to(value);
}

bool is_pixel(glm::vec2 place) {
    return std::abs(place.x) <= k_farthest_pixel && std::abs(place.y) <= k_farthest_pixel;
}

bool is_date(const render::Date& date) {
    constexpr double k_day = 86400;
    return std::abs(date.year) <= 9999 && date.month >= 0 && date.month < 12 && date.day >= 1 &&
           date.day <= 31 && date.seconds >= 0 && date.seconds <= k_day;
}

/// Checks values from a file of unknown origin; values from options are checked where they are parsed.
bool is_sound(const render::FrameState& state) {
    const auto is_camera = [](const render::OrbitCamera& camera) {
        return render::parse_camera(to_string(camera)) == camera;
    };
    bool positive = true;
    render::for_each_number([&](const auto& field) { positive = positive && state.*field.member > 0; });
    const Extent size = state.extent;
    return state.frame >= 0 && state.frame <= render::k_last_frame && size.width >= 1 && size.height >= 1 &&
           std::max(size.width, size.height) <= k_largest_side && positive &&
           is_pixel(state.mouse.position) && is_pixel(state.mouse.pressed_at) && is_date(state.date) &&
           is_camera(state.camera) && (!state.initial_camera || is_camera(*state.initial_camera));
}

} // namespace

Moment moment_of(SceneRequest scene, const FrameSequence& sequence, render::FrameState state) {
    Moment moment{std::move(scene), sequence};
    moment.sequence.frames = {state.frame};
    moment.sequence.input.reset(); // only its file name is kept
    moment.sequence.state = std::move(state);
    return moment;
}

Json to_json(const Moment& moment) {
    const SceneRequest& scene = moment.scene;
    Json json{{"scene", scene.path.string()}};
    put_unless_default(json, "set", scene.sets);
    put_unless_default(json, "define", scene.defines);
    put_unless_default(json, "channel", scene.channels);
    put_unless_default(json, "media", scene.files.media.string());
    put_unless_default(json, "double", scene.doubles.value_or(false));
    put_unless_default(json, "double_hashes", scene.double_hashes);
    put_unless_default(json, "input", moment.sequence.input_file);
    if (moment.sequence.lead_in_fps)
        json["lead_in_fps"] = *moment.sequence.lead_in_fps;
    json["state"] = changes_of(moment.sequence.state);
    return json;
}

Result<Moment> moment_of(const Json& json) {
    const auto damaged = [] {
        return fail(ErrorCode::load, "the moment has another form, or values that no option accepts");
    };
    try {
        Moment moment;
        SceneRequest& scene = moment.scene;
        scene.path = json.at("scene").get<std::string>();
        take(json, "set", scene.sets);
        take(json, "define", scene.defines);
        take(json, "channel", scene.channels);
        std::string media;
        take(json, "media", media);
        scene.files.media = media;
        scene.doubles = json.value("double", false);
        take(json, "double_hashes", scene.double_hashes);
        take(json, "input", moment.sequence.input_file);
        if (json.contains("lead_in_fps"))
            moment.sequence.lead_in_fps = json["lead_in_fps"].get<double>();
        moment.sequence.state = TRY(frame_state_of(json.at("state")));
        moment.sequence.frames = {moment.frame()};
        const bool sound = is_sound(moment.sequence.state) && moment.sequence.lead_in_fps.value_or(1) > 0;
        return sound ? Result<Moment>(std::move(moment)) : damaged();
    } catch (const Json::exception&) { // JSON of another form
        return damaged();
    }
}

std::string capture_command(const Moment& moment) {
    std::vector<std::string> words{"tidemark", "capture", file_word(moment.scene.path)};
    const std::vector<std::string> options =
        option_words(moment.scene, moment.sequence.input_file, moment.sequence.state);
    words.insert(words.end(), options.begin(), options.end());
    if (moment.scene.doubles.value_or(false))
        words.insert(words.end(), {"--precision", "double"});
    if (moment.scene.double_hashes)
        words.emplace_back("--double-hashes");
    return shell_words(words);
}

std::vector<std::string> merged(std::vector<std::string> older, const std::vector<std::string>& newer) {
    const auto name_of = [](std::string_view setting) { return setting.substr(0, setting.find('=')); };
    std::erase_if(older, [&](const std::string& setting) {
        return std::ranges::find(newer, name_of(setting), name_of) != newer.end();
    });
    older.insert(older.end(), newer.begin(), newer.end());
    return older;
}

void erase_named(const std::vector<std::string>& sets, std::vector<scene::KnobSetting>& knobs) {
    std::erase_if(knobs, [&](const scene::KnobSetting& knob) {
        return std::ranges::any_of(sets,
                                   [&](const std::string& set) { return set.starts_with(knob.name + "="); });
    });
}

std::vector<std::pair<std::string, std::string>> metadata_of(const scene::Scene& scene,
                                                             const Moment& moment) {
    const render::FrameState& state = moment.sequence.state;
    const glm::vec4 mouse = state.mouse.uniform();
    std::vector<std::pair<std::string, std::string>> metadata{
        {"Scene", scene.file.string()},
        {"Frame", fmt::format("{}", state.frame)},
        {"iTime", fmt::format("{}", state.seconds())},
        {"iMouse", fmt::format("{},{},{},{}", mouse.x, mouse.y, mouse.z, mouse.w)},
        {"Camera", to_string(state.camera)},
        {"Software", fmt::format("tidemark {}", k_version)}};
    std::string knobs;
    for (const scene::Knob& knob : scene.knobs)
        knobs += fmt::format("{}{}={}", knobs.empty() ? "" : "; ", knob.name,
                             scene::to_string(knob, value_after(knob, state.knobs)));
    if (!knobs.empty())
        metadata.emplace_back("Knobs", std::move(knobs));
    metadata.emplace_back(k_moment, dump(to_json(moment)));
    return metadata;
}

} // namespace tidemark::host
