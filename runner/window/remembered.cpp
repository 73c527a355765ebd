#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "host/console.hpp"
#include "host/json.hpp"
#include "window/viewer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <span>

namespace tidemark::window {

using namespace host;
using host::to_string;
namespace {

namespace fs = std::filesystem;

constexpr int k_version_of_format = 1;
constexpr size_t k_digits = 16;
/// Bound of plausible screen coordinates, in pixels.
constexpr int k_farthest = 1 << 15;

/// Returns the state folder; empty if neither $XDG_STATE_HOME nor $HOME is an absolute path.
fs::path state_folder() {
    const auto folder_in = [](const char* variable) {
        const char* value = std::getenv(variable);
        const fs::path folder(value ? value : "");
        return folder.is_absolute() ? folder : fs::path();
    };
    if (const fs::path state = folder_in("XDG_STATE_HOME"); !state.empty())
        return state / "tidemark";
    const fs::path home = folder_in("HOME");
    return home.empty() ? home : home / ".local" / "state" / "tidemark";
}

std::string whole_name(const fs::path& scene) {
    std::error_code ignored;
    return fs::weakly_canonical(scene, ignored).string();
}

std::string file_name(const fs::path& scene) {
    const std::string name = whole_name(scene);
    return sha256(std::as_bytes(std::span(name))).substr(0, k_digits) + ".json";
}

/// Returns a saved moment. Prints a warning if it is damaged: the others are still of use.
std::optional<Moment> readable(const Json& json) {
    auto moment = moment_of(json);
    if (moment)
        return *std::move(moment);
    say(fmt::format("warning: a moment of the last window is left out: {}", moment.error().message));
    return std::nullopt;
}

/// Returns views that are in no file of presets. Windows of an earlier version kept moments without a name.
std::vector<Preset> views_of(const Json& json) {
    std::vector<Preset> views;
    for (const Json& each : json)
        if (each.contains("name")) {
            if (auto view = preset_of(each))
                views.push_back(*std::move(view));
        } else if (auto moment = readable(each)) {
            views.push_back(preset_of(*moment, fmt::format("view {}", views.size() + 1)));
        }
    return views;
}

Json json_of(const WindowPlace& place) {
    return {place.x, place.y, place.size.width, place.size.height};
}

std::optional<WindowPlace> place_of(const Json& json) {
    const auto numbers = json.get<std::vector<int>>();
    const auto sound = [](int number) { return std::abs(number) <= k_farthest; };
    if (numbers.size() != 4 || !std::ranges::all_of(numbers, sound) || numbers[2] < 1 || numbers[3] < 1)
        return std::nullopt;
    return WindowPlace{numbers[0], numbers[1], {numbers[2], numbers[3]}};
}

Json json_of(const std::vector<Binding>& bindings) {
    Json json = Json::array();
    for (const Binding& binding : bindings)
        json.push_back({{"channel", binding.controller.channel},
                        {"controller", binding.controller.number},
                        {"knob", binding.part.knob},
                        {"component", binding.part.component}});
    return json;
}

std::vector<Binding> bindings_of(const Json& json) {
    std::vector<Binding> bindings;
    for (const Json& each : json)
        bindings.push_back({{each.at("channel").get<int>(), each.at("controller").get<int>()},
                            {each.at("knob").get<std::string>(), each.at("component").get<size_t>()}});
    return bindings;
}

/// Returns nothing if the text is not valid or belongs to another scene or format version.
std::optional<Remembered> parse(const std::string& text, const fs::path& scene) {
    try {
        const Json json = parse_json(text);
        if (json.at("tidemark_view") != k_version_of_format || json.at("scene") != whole_name(scene))
            return std::nullopt;
        Remembered state;
        if (const Json& left = json.at("moment"); !left.is_null())
            state.moment = readable(left);
        state.place = place_of(json.at("window"));
        state.scale = RenderScale::named(json.value("scale", "")); // older files have none
        state.controls_open = json.at("controls").get<bool>();
        state.views = views_of(json.at("views"));
        state.morph_seconds = std::clamp(json.value("morph", 0.0), 0.0, k_longest_morph_seconds);
        state.paused = json.value("paused", false);
        state.sound = {std::clamp(json.value("volume", 1.0), 0.0, 1.0), json.value("muted", false)};
        state.controllers = bindings_of(json.value("controllers", Json::array()));
        return state;
    } catch (const Json::exception&) {
        return std::nullopt;
    }
}

std::string text_of(const fs::path& scene, const Remembered& state) {
    Json views = Json::array();
    for (const Preset& view : state.views)
        views.push_back(to_json(view));
    return dump(Json{{"tidemark_view", k_version_of_format},
                     {"scene", whole_name(scene)},
                     {"moment", state.moment ? to_json(*state.moment) : Json()},
                     {"window", state.place ? json_of(*state.place) : Json::array()},
                     {"scale", state.scale ? Json(state.scale->name()) : Json("")},
                     {"controls", state.controls_open},
                     {"paused", state.paused},
                     {"volume", state.sound.volume},
                     {"muted", state.sound.muted},
                     {"morph", state.morph_seconds},
                     {"views", std::move(views)},
                     {"controllers", json_of(state.controllers)}},
                2) +
           "\n";
}

Result<void> write(const fs::path& scene, const Remembered& state) {
    const OutputPath folder = OutputPath::typed(state_folder());
    TRY(make_folder(folder));
    return write_file(folder / file_name(scene), text_of(scene, state));
}

} // namespace

std::optional<Remembered> recall(const fs::path& scene) {
    std::error_code ignored;
    const fs::path folder = state_folder();
    const fs::path file = folder / file_name(scene);
    if (folder.empty() || !fs::exists(file, ignored))
        return std::nullopt;
    const auto text = read_file(file);
    auto state = text ? parse(*text, scene) : std::nullopt;
    if (!state)
        say(fmt::format("cannot read the last window's state from '{}': the window starts anew",
                        file.string()));
    return state;
}

void remember(const fs::path& scene, const Remembered& state) {
    if (state_folder().empty())
        return;
    if (auto written = write(scene, state); !written)
        say(fmt::format("warning: the window's state is not saved: {}", written.error().message));
}

std::string words_of(const Remembered& state) {
    std::vector<std::string> words;
    if (state.moment) {
        const render::FrameState& shown = state.moment->sequence.state;
        for (const scene::KnobSetting& knob : shown.knobs)
            words.push_back(fmt::format("{} = {}", knob.name, scene::to_string(knob.value)));
        if (shown.camera != render::OrbitCamera())
            words.push_back("camera " + to_string(shown.camera));
        words.push_back(fmt::format("{:.3f} s{}", shown.seconds(), state.paused ? ", paused" : ""));
    }
    if (state.scale && *state.scale != RenderScale())
        words.push_back("scale " + state.scale->name());
    if (state.sound.muted)
        words.emplace_back("muted");
    else if (state.sound.volume != 1)
        words.push_back(fmt::format("volume {:.0f} %", 100 * state.sound.volume));
    return fmt::format("{}", fmt::join(words, ", "));
}

} // namespace tidemark::window
