#include "host/input_script.hpp"

#include "base/encoding.hpp"
#include "base/file.hpp"
#include "host/requests.hpp"
#include "scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace tidemark::host {

bool Controls::handle(const ControlEvent& event, double height) {
    height_ = height;
    return std::visit([this](const auto& happened) { return take(happened); }, event);
}

bool Controls::take(const PointerMoved& event) {
    const double dx = event.at.x - pointer_.x;
    const double dy = event.at.y - pointer_.y;
    pointer_ = event.at;
    if (turning_) {
        mouse_.move(event.at.x, event.at.y);
        camera_.turn(dx, dy, height_);
    }
    if (panning_)
        camera_.pan(dx, dy, height_);
    return turning_ || panning_;
}

bool Controls::take(const ButtonPressed& event) {
    pointer_ = event.at;
    if (event.button == Button::left) {
        turning_ = true;
        mouse_.press(event.at.x, event.at.y);
    } else if (event.button == Button::middle) {
        panning_ = true;
    } else {
        right_down_ = true;
    }
    return true;
}

bool Controls::take(const ButtonReleased& event) {
    if (event.button == Button::left) {
        turning_ = false;
        mouse_.release();
    } else if (event.button == Button::middle) {
        panning_ = false;
    } else {
        right_down_ = false;
    }
    return true;
}

bool Controls::take(const WheelTurned& event) {
    camera_.zoom(event.up);
    return true;
}

bool Controls::take(const KeyPressed& event) {
    keyboard_.press(js_key_code(event.key));
    return true;
}

bool Controls::take(const KeyReleased& event) {
    keyboard_.release(js_key_code(event.key));
    return true;
}

bool Controls::take(const CameraReset&) {
    camera_ = initial_camera_;
    return true;
}

bool Controls::take(const KnobTurned& event) {
    scene::set(knobs_, event.setting);
    return true;
}

bool Controls::take(const PointerFollowed& event) {
    pointer_ = event.at;
    mouse_.position = glm::floor(glm::dvec2(event.at.x, event.at.y)) + 0.0; // -0 + 0 is 0
    return true;
}

std::vector<std::string> Controls::release(const std::vector<scene::Knob>& knobs) {
    std::vector<std::string> refused;
    std::erase_if(knobs_, [&](const scene::KnobSetting& held) {
        const auto knob = std::ranges::find(knobs, held.name, &scene::Knob::name);
        if (knob == knobs.end())
            return false; // the next save may declare it again
        const auto value = value_for(*knob, held.value);
        if (!value)
            refused.push_back(value.error().message);
        return !value || (knob->value == knob->initial && *value == knob->initial);
    });
    return refused;
}

void Controls::adopt(const render::FrameState& state) {
    mouse_ = state.mouse;
    mouse_.release();
    mouse_.frame_drawn();
    camera_ = state.camera;
    knobs_ = state.knobs;
}

void Controls::stretch(Extent from, Extent to) {
    mouse_.stretch(from, to);
    pointer_.x *= double(to.width) / from.width;
    pointer_.y *= double(to.height) / from.height;
}

void Controls::fill(render::FrameState& state) const {
    state.mouse = mouse_;
    state.right_button = right_down_;
    state.keys = keyboard_.texels();
    state.camera = camera_;
    state.initial_camera = initial_camera_;
    for (const scene::KnobSetting& setting : knobs_)
        scene::set(state.knobs, setting);
}

void Controls::frame_drawn() {
    mouse_.frame_drawn();
    keyboard_.frame_drawn();
}

namespace {

constexpr std::pair<std::string_view, Button> k_buttons[] = {
    {"left", Button::left}, {"middle", Button::middle}, {"right", Button::right}};

constexpr std::string_view k_blanks = " \t\r";

/// Removes the first token from `line` and returns it.
std::string_view take_word(std::string_view& line) {
    line.remove_prefix(std::min(line.find_first_not_of(k_blanks), line.size()));
    const std::string_view word = line.substr(0, line.find_first_of(k_blanks));
    line.remove_prefix(word.size());
    return word;
}

template <class T>
bool take_number(std::string_view& line, T& number, T least, T most) {
    const auto read = number_from<T>(take_word(line));
    number = read.value_or(number);
    return read && number >= least && number <= most;
}

bool take_position(std::string_view& line, PointerPosition& at) {
    return take_number(line, at.x, -k_farthest_pixel, k_farthest_pixel) &&
           take_number(line, at.y, -k_farthest_pixel, k_farthest_pixel);
}

bool take_button(std::string_view& line, Button& button) {
    const std::string_view word = take_word(line);
    const auto* found = std::find_if(std::begin(k_buttons), std::end(k_buttons),
                                     [&](const auto& known) { return known.first == word; });
    if (found == std::end(k_buttons))
        return false;
    button = found->second;
    return true;
}

/// Names of keys that a recording may have instead of their codes: as JavaScript's KeyboardEvent.key, in
/// lower case.
constexpr std::pair<std::string_view, int> k_key_names[] = {
    {"backspace", 8}, {"tab", 9},        {"enter", 13},      {"shift", 16},   {"control", 17},
    {"ctrl", 17},     {"alt", 18},       {"capslock", 20},   {"escape", 27},  {"esc", 27},
    {"space", 32},    {"pageup", 33},    {"pagedown", 34},   {"end", 35},     {"home", 36},
    {"left", 37},     {"arrowleft", 37}, {"up", 38},         {"arrowup", 38}, {"right", 39},
    {"down", 40},     {"insert", 45},    {"arrowright", 39}, {"delete", 46},  {"arrowdown", 40}};

/// Returns the code of a key from its name, in upper or lower case: a letter, one of `k_key_names`, or F1 to
/// F24.
std::optional<int> key_of_name(std::string_view name) {
    const std::string lower = lower_case(std::string(name));
    if (lower.size() == 1 && lower[0] >= 'a' && lower[0] <= 'z')
        return lower[0] - 'a' + js_key_code(Key::a);
    const auto* const known =
        std::ranges::find(k_key_names, std::string_view(lower), &std::pair<std::string_view, int>::first);
    if (known != std::end(k_key_names))
        return known->second;
    const auto function =
        lower.starts_with('f') ? number_from<int>(std::string_view(lower).substr(1)) : std::nullopt;
    return function && *function >= 1 && *function <= 24 ? std::optional(js_key_code(Key::f1) + *function - 1)
                                                         : std::nullopt;
}

/// Takes a key's code or name.
bool take_key(std::string_view& line, Key& key) {
    std::string_view word = take_word(line);
    const auto code = number_from<int>(word) ? number_from<int>(word) : key_of_name(word);
    if (!code || *code < 1 || *code > 255)
        return false;
    key = Key(*code);
    return true;
}

/// Parses the rest of a line after `set` as NAME=VALUE; nullopt if it does not have that form.
std::optional<Result<scene::KnobSetting>> take_setting(std::string_view line) {
    line.remove_prefix(std::min(line.find_first_not_of(k_blanks), line.size()));
    line = line.substr(0, line.find_last_not_of(k_blanks) + 1);
    const auto split = scene::split_setting(line, "set");
    return split ? std::optional(scene::parse_knob_setting(split->first, split->second)) : std::nullopt;
}

/// A kind of event: its name, its syntax for error messages, and its parser.
struct Kind {
    std::string_view name;
    std::string_view form;
    std::optional<ControlEvent> (*take)(std::string_view& line);
};

template <class Event, class Take>
std::optional<ControlEvent> event_if(Take&& take) {
    Event event;
    if (!take(event))
        return std::nullopt;
    return event;
}

constexpr Kind k_kinds[] = {
    {"press", "press left|middle|right X Y",
     [](std::string_view& line) {
         return event_if<ButtonPressed>([&](ButtonPressed& event) {
             return take_button(line, event.button) && take_position(line, event.at);
         });
     }},
    {"release", "release left|middle|right",
     [](std::string_view& line) {
         return event_if<ButtonReleased>(
             [&](ButtonReleased& event) { return take_button(line, event.button); });
     }},
    {"move", "move X Y",
     [](std::string_view& line) {
         return event_if<PointerMoved>([&](PointerMoved& event) { return take_position(line, event.at); });
     }},
    {"point", "point X Y",
     [](std::string_view& line) {
         return event_if<PointerFollowed>(
             [&](PointerFollowed& event) { return take_position(line, event.at); });
     }},
    {"wheel", "wheel UP",
     [](std::string_view& line) {
         return event_if<WheelTurned>([&](WheelTurned& event) {
             return take_number(line, event.up, -k_farthest_pixel, k_farthest_pixel);
         });
     }},
    {"keydown", "keydown KEY (a name as in a, space, left or F1, or a code from 1 to 255)",
     [](std::string_view& line) {
         return event_if<KeyPressed>([&](KeyPressed& event) { return take_key(line, event.key); });
     }},
    {"keyup", "keyup KEY (a name as in a, space, left or F1, or a code from 1 to 255)",
     [](std::string_view& line) {
         return event_if<KeyReleased>([&](KeyReleased& event) { return take_key(line, event.key); });
     }},
    {"camera", "camera reset",
     [](std::string_view& line) {
         return event_if<CameraReset>([&](CameraReset&) { return take_word(line) == "reset"; });
     }},
};

tl::unexpected<Error> refuse(std::string message) {
    return fail(ErrorCode::load, std::move(message)); // the caller adds the place
}

Result<TimedEvent> parse_line(std::string_view line) {
    TimedEvent timed;
    std::string_view rest = line;
    if (!take_number(rest, timed.frame, 0, render::k_last_frame))
        return refuse("a line must begin with a frame number, as in `12 move 100 50`");
    const std::string_view name = take_word(rest);
    if (name == "set") {
        auto setting = take_setting(rest);
        if (!setting)
            return refuse(fmt::format("give it as `{} set NAME=VALUE`", timed.frame));
        timed.event = KnobTurned{TRY(std::move(*setting))};
        return timed;
    }
    const auto* kind = std::find_if(std::begin(k_kinds), std::end(k_kinds),
                                    [&](const Kind& known) { return known.name == name; });
    if (kind == std::end(k_kinds))
        return refuse(fmt::format(
            "unknown event '{}': give press, release, move, point, wheel, keydown, keyup, set or camera",
            name));
    const auto event = kind->take(rest);
    if (!event || !take_word(rest).empty())
        return refuse(fmt::format("give it as `{} {}`", timed.frame, kind->form));
    timed.event = *event;
    return timed;
}

std::string_view name_of(Button button) {
    return std::find_if(std::begin(k_buttons), std::end(k_buttons),
                        [&](const auto& known) { return known.second == button; })
        ->first;
}

/// Formats an event as in its line.
struct Wording {
    std::string operator()(const ButtonPressed& event) const {
        return fmt::format("press {} {} {}", name_of(event.button), event.at.x, event.at.y);
    }
    std::string operator()(const ButtonReleased& event) const {
        return fmt::format("release {}", name_of(event.button));
    }
    std::string operator()(const PointerMoved& event) const {
        return fmt::format("move {} {}", event.at.x, event.at.y);
    }
    std::string operator()(const PointerFollowed& event) const {
        return fmt::format("point {} {}", event.at.x, event.at.y);
    }
    std::string operator()(const WheelTurned& event) const { return fmt::format("wheel {}", event.up); }
    std::string operator()(const KeyPressed& event) const {
        return fmt::format("keydown {}", js_key_code(event.key));
    }
    std::string operator()(const KeyReleased& event) const {
        return fmt::format("keyup {}", js_key_code(event.key));
    }
    std::string operator()(const CameraReset&) const { return "camera reset"; }
    std::string operator()(const KnobTurned& event) const {
        return fmt::format("set {}={}", event.setting.name, scene::to_string(event.setting.value));
    }
};

} // namespace

Result<InputScript> parse_input_script(std::string_view text, const std::string& file) {
    InputScript script;
    int number = 0;
    while (!text.empty()) {
        ++number;
        const size_t end = text.find('\n');
        std::string_view line = text.substr(0, end);
        text.remove_prefix(end == text.npos ? text.size() : end + 1);
        line = line.substr(0, line.find('#'));
        if (line.find_first_not_of(k_blanks) == line.npos)
            continue;
        auto event = parse_line(line);
        if (!event)
            return fail(error_at({file, number}, event.error().message));
        if (!script.empty() && event->frame < script.back().frame)
            return fail(error_at({file, number},
                                 fmt::format("frame {} follows frame {}: frames must be in ascending order",
                                             event->frame, script.back().frame)));
        script.push_back(*event);
    }
    return script;
}

Result<InputScript> load_input_script(const std::filesystem::path& file) {
    auto text = TRY(read_text_file(file));
    return parse_input_script(text, file.string());
}

bool turns_knobs(const InputScript& script) {
    return std::ranges::any_of(
        script, [](const TimedEvent& timed) { return std::holds_alternative<KnobTurned>(timed.event); });
}

Result<void> check_knobs(const InputScript& script, std::vector<scene::Knob> knobs) {
    for (const TimedEvent& timed : script)
        if (const auto* turned = std::get_if<KnobTurned>(&timed.event))
            TRY(scene::set_knob(knobs, turned->setting));
    return {};
}

std::string to_string(const InputScript& script) {
    std::string text;
    for (const TimedEvent& timed : script)
        text += fmt::format("{} {}\n", timed.frame, std::visit(Wording{}, timed.event));
    return text;
}

render::FrameState without_recorded(render::FrameState state) {
    const render::FrameState plain;
    state.mouse = plain.mouse;
    state.right_button = plain.right_button;
    state.keys = plain.keys;
    state.camera = state.initial_camera.value_or(state.camera);
    state.initial_camera.reset();
    state.knobs.clear();
    return state;
}

void Replay::go_back(int frame) {
    while (!script_.empty() && script_.back().frame > frame)
        script_.pop_back();
}

void Replay::note(int frame, const ControlEvent& event) {
    go_back(frame);
    script_.push_back({frame, event});
}

void Replay::fill(render::FrameState& state) {
    if (state.frame < frame_) {
        controls_ = Controls(camera_);
        next_ = 0;
        frame_ = 0;
    }
    for (; next_ < script_.size() && script_[next_].frame <= state.frame; ++next_) {
        if (script_[next_].frame > frame_)
            controls_.frame_drawn();
        frame_ = script_[next_].frame;
        controls_.handle(script_[next_].event, state.extent.height);
    }
    if (state.frame > frame_)
        controls_.frame_drawn();
    frame_ = state.frame;
    controls_.fill(state);
}

} // namespace tidemark::host
