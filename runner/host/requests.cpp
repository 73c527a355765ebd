#include "host/requests.hpp"

#include "base/encoding.hpp"
#include "base/file.hpp"
#include "host/console.hpp"
#include "host/diagnostics.hpp"
#include "host/forked.hpp"
#include "host/presets.hpp"
#include "shader/definitions.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <utility>

namespace tidemark::host {
namespace {

/// The limit for all ranges together.
constexpr size_t k_most_frames = 10'000'000;

constexpr std::string_view k_down = ",down";

/// Parses one range: `7`, `1-10`, `1-10x3`.
bool take_range(std::string_view& text, std::vector<int>& frames) {
    int first = 0;
    if (!consume_number(text, first) || first < 0 || first > render::k_last_frame)
        return false;
    int last = first;
    int step = 1;
    if (consume(text, '-') && (!consume_number(text, last) || last < 0 || last > render::k_last_frame))
        return false;
    if (consume(text, 'x') && (!consume_number(text, step) || step < 1))
        return false;
    const int steps = std::abs(last - first) / step;
    if (frames.size() + size_t(steps) >= k_most_frames)
        return false;
    const int direction = last < first ? -1 : 1;
    for (int i = 0; i <= steps; ++i)
        frames.push_back(first + direction * i * step);
    return true;
}

/// The frame rates of television, which are written rounded: 1000/1001 of a whole number.
constexpr std::pair<std::string_view, int> k_rounded_rates[] = {
    {"23.976", 24}, {"29.97", 30}, {"47.952", 48}, {"59.94", 60}, {"119.88", 120}};

/// Parses a frame rate: a number, or a fraction as in 24000/1001. 23.976, 29.97 and the like are read as the
/// fractions that they round.
std::optional<double> parse_rate(std::string_view text) {
    for (const auto& [rounded, whole] : k_rounded_rates)
        if (text == rounded)
            return whole * 1000.0 / 1001;
    const std::vector<double> parts = numbers_from<double>(text, '/');
    if (parts.size() == 2 && parts[0] > 0 && parts[1] > 0)
        return parts[0] / parts[1];
    return number_from<double>(text);
}

/// Parses a number of `render::k_frame_fields`.
std::optional<double> parse_number(std::string_view option, std::string_view text) {
    return option == "--fps" ? parse_rate(text) : number_from<double>(text);
}

/// Formats a value as its option accepts it.
struct Typed {
    std::string operator()(double number) const { return fmt::format("{}", number); }
    std::string operator()(const std::optional<double>& number) const { return fmt::format("{}", *number); }
    std::string operator()(const Extent& size) const { return fmt::format("{}x{}", size.width, size.height); }
    std::string operator()(const render::Mouse& mouse) const {
        const glm::vec2 at = mouse.position, from = mouse.pressed_at;
        const bool dragged = at != from || (mouse.down && !mouse.is_new);
        return fmt::format("{},{}{}{}", at.x, at.y, dragged ? fmt::format(",{},{}", from.x, from.y) : "",
                           mouse.down ? k_down : "");
    }
    std::string operator()(const render::Date& date) const {
        const int minutes = int(date.seconds / 60);
        return fmt::format("{}-{:02}-{:02}T{:02}:{:02}:{}", date.year, date.month + 1, date.day, minutes / 60,
                           minutes % 60, date.seconds - 60 * minutes);
    }
    std::string operator()(const render::OrbitCamera& camera) const { return to_string(camera); }
    std::string operator()(const scene::Setting& setting) const { return setting.name + "=" + setting.value; }
    std::string operator()(const scene::KnobSetting& setting) const {
        return setting.name + "=" + scene::to_string(setting.value);
    }
    std::string operator()(const std::string& text) const { return text; }
};

/// Returns true if the options would describe another state without this field.
template <class T>
bool must_be_said(const render::FrameState& state, const render::FrameField<T>& field) {
    if (field.option == "--frame")
        return !state.time;
    if (field.option == "--camera" && state.moves_camera())
        return true;
    return field.option == "--size" || state.*field.member != render::FrameState().*field.member;
}

/// Checks the values that a saved moment gives the scene's knobs. If the request allows another text of the
/// scene, a refused value is a warning, as for --set.
Result<void> check_state(const SceneRequest& request, const render::FrameState& state,
                         const std::vector<scene::Knob>& knobs) {
    for (const scene::KnobSetting& setting : state.knobs) {
        const auto knob = std::ranges::find(knobs, setting.name, &scene::Knob::name);
        if (knob == knobs.end())
            continue;
        if (auto value = value_for(*knob, setting.value); !value) {
            if (!request.knobs_may_go)
                return fail(std::move(value.error()));
            say(finding_of({{request.path.string()}, Severity::warning, std::move(value.error().message)}));
        }
    }
    return {};
}

void say_warnings(const std::vector<Diagnostic>& warnings, const std::vector<Diagnostic>& said) {
    for (const Diagnostic& warning : warnings)
        if (std::ranges::find(said, warning) == said.end())
            say(finding_of(warning));
}

/// Returns the warnings about uniforms that the text alone declares and to which the request gives a value.
std::vector<Diagnostic> answered(const scene::Scene& scene, const SceneRequest& request,
                                 const std::vector<scene::KnobSetting>& settings) {
    std::vector<Diagnostic> warnings = request.said;
    for (const scene::Knob& knob : scene.knobs) {
        const bool given =
            std::ranges::any_of(request.sets,
                                [&](const std::string& set) { return set.starts_with(knob.name + "="); }) ||
            std::ranges::find(settings, knob.name, &scene::KnobSetting::name) != settings.end();
        if (knob.plain && given)
            std::ranges::copy_if(scene.warnings, std::back_inserter(warnings),
                                 [&](const Diagnostic& warning) { return warning.where == knob.where; });
    }
    return warnings;
}

/// Reads the text of the scene if its path is `-`, standard input. It counts as a file of the current folder.
/// Returns what is wrong.
std::string read_scene_of_input(SceneRequest& request, const std::string& path) {
    if (path != "-")
        return {};
    auto text = read_all(STDIN_FILENO, k_largest_text);
    if (!text)
        return fmt::format("cannot read standard input: {}", system_reason(text.error()));
    if (text->find('\0') != std::string::npos)
        return "standard input has binary data, not shader text";
    std::error_code ignored;
    request.files.unsaved[std::filesystem::weakly_canonical(path, ignored)] = *std::move(text);
    return {};
}

template <class T>
Result<void> keep(Result<T> parsed, auto& place) {
    if (!parsed)
        return fail(std::move(parsed.error()));
    place = *std::move(parsed);
    return {};
}

/// Drops the window's clock: --frame, --frames and --time refer to a run with a constant time step from its
/// start.
void leave_window_time(FrameSequence& sequence) {
    render::FrameState& state = sequence.state;
    state.time.reset();
    state.time_delta.reset();
    if (const auto fps = std::exchange(sequence.lead_in_fps, std::nullopt))
        state.fps = *fps;
}

Result<void> resolve_time(const FrameOptions& options, FrameSequence& sequence) {
    render::FrameState& state = sequence.state;
    if (options.frame || options.frames || options.time)
        leave_window_time(sequence);
    for (const auto& [option, number] : options.numbers)
        if (!(number > 0) || !std::isfinite(number))
            return fail(ErrorCode::usage, fmt::format("{} {}: give a number above 0", option, number));
    render::for_each_number([&](const auto& field) {
        const auto given = options.numbers.find(field.option);
        if (given == options.numbers.end())
            return;
        const bool leads_in = field.member == &render::FrameState::fps && sequence.lead_in_fps;
        (leads_in ? *sequence.lead_in_fps : state.*field.member) = given->second;
    });
    if (options.frame && (*options.frame < 0 || *options.frame > render::k_last_frame))
        return fail(ErrorCode::usage, fmt::format("--frame {}: frames count from 0 to {}", *options.frame,
                                                  render::k_last_frame));
    if (options.frame)
        sequence.frames = {*options.frame};
    if (options.time && !std::isfinite(*options.time))
        return fail(ErrorCode::usage, "--time: give a finite number of seconds");
    if (options.time) {
        state = render::at_time(*options.time, state);
        sequence.frames = {state.frame};
    }
    return options.frames ? keep(parse_frames(*options.frames), sequence.frames) : Result<void>();
}

} // namespace

std::vector<std::string> option_words(const SceneRequest& request) {
    std::vector<std::string> words;
    const auto add = [&words](const char* option, const std::vector<std::string>& values) {
        for (const std::string& value : values)
            words.insert(words.end(), {option, value});
    };
    add("--set", request.sets);
    add("--define", request.defines);
    add("--channel", request.channels);
    if (!request.files.media.empty())
        add("--media", {request.files.media.string()});
    if (request.files.allow_outside)
        words.emplace_back("--allow-outside");
    return words;
}

std::vector<std::string> option_words(const render::FrameState& state) {
    std::vector<std::string> words;
    const auto add = [&words]<class T>(std::string_view option, const T& value) {
        if constexpr (std::invocable<Typed, T>)
            words.insert(words.end(), {std::string(option), Typed{}(value)});
        else if constexpr (requires { Typed{}(value.front()); })
            for (const auto& each : value)
                words.insert(words.end(), {std::string(option), Typed{}(each)});
    };
    render::for_each_field([&](const auto& field) {
        if (!field.option.empty() && must_be_said(state, field))
            add(field.option, state.*field.member);
    });
    return words;
}

std::vector<std::string> option_words(const SceneRequest& scene, const std::string& recording,
                                      render::FrameState state) {
    std::vector<std::string> words = option_words(scene); // first, so that later values override these
    if (!recording.empty()) {
        state = without_recorded(std::move(state));
        words.insert(words.end(), {"--input", recording});
    }
    const std::vector<std::string> typed = option_words(state);
    words.insert(words.end(), typed.begin(), typed.end());
    return words;
}

std::string to_string(const render::OrbitCamera& camera) {
    const glm::dvec3& target = camera.target;
    return fmt::format("{},{},{}{}", camera.azimuth, camera.elevation, camera.distance,
                       target == glm::dvec3(0) ? "" : fmt::format(",{},{},{}", target.x, target.y, target.z));
}

Result<scene::Scene> load_as_written(const SceneRequest& request) {
    auto scene = scene::load_scene(request.path, request.files);
    if (scene)
        say_warnings(scene->warnings, answered(*scene, request, {}));
    return scene;
}

Result<void> apply_options(const SceneRequest& request, scene::Scene& scene) {
    std::vector<Diagnostic> said = scene.warnings;
    said.insert(said.end(), request.said.begin(), request.said.end());
    using Override = Result<void> (*)(scene::Scene&, std::string_view);
    const std::pair<const std::vector<std::string>&, Override> overrides[] = {
        {request.defines, glsl::override_definition},
        {request.sets, scene::override_knob},
        {request.channels, scene::override_channel},
    };
    for (const auto& [settings, apply] : overrides)
        for (const std::string& setting : settings)
            if (auto applied = apply(scene, setting); !applied) {
                if (apply == scene::override_channel || !request.knobs_may_go)
                    return applied;
                scene.warnings.push_back(
                    {{request.path.string()}, Severity::warning, std::move(applied.error().message)});
            }
    say_warnings(scene.warnings, said);
    return {};
}

Result<scene::Scene> load(const SceneRequest& request) {
    auto scene = load_as_written(request);
    if (scene)
        TRY(apply_options(request, *scene));
    return scene;
}

Result<scene::Scene> load(const SceneRequest& request, const FrameSequence& sequence) {
    return load(request, sequence, scene::load_scene(request.path, request.files));
}

Result<scene::Scene> load(const SceneRequest& request, const FrameSequence& sequence,
                          Result<scene::Scene> files) {
    auto scene = TRY(std::move(files));
    say_warnings(scene.warnings, answered(scene, request, sequence.state.knobs));
    TRY(apply_options(request, scene));
    if (sequence.input)
        if (auto known = check_knobs(*sequence.input, scene.knobs); !known)
            return fail(ErrorCode::usage,
                        fmt::format("--input {}: {}", sequence.input_file, known.error().message));
    TRY(check_state(request, sequence.state, scene.knobs));
    return scene;
}

std::string file_word(const std::filesystem::path& file) {
    const std::string name = file.string();
    return name.starts_with('-') ? "./" + name : name;
}

std::filesystem::path file_beside(const std::filesystem::path& scene, const std::string& name) {
    std::error_code ignored;
    return std::filesystem::is_directory(scene, ignored)
               ? scene / name
               : std::filesystem::path(scene).replace_extension(name);
}

glsl::Precision precision_of(const SceneRequest& request) {
    return !request.doubles.value_or(false) ? glsl::Precision::single
           : request.double_hashes          ? glsl::Precision::promoted_whole
                                            : glsl::Precision::promoted;
}

render::FrameStates states_of(const FrameSequence& sequence) {
    std::optional<Replay> replay;
    if (sequence.input)
        replay.emplace(*sequence.input, sequence.state.camera);
    render::FrameState leading = sequence.state;
    if (sequence.lead_in_fps) {
        leading.time.reset();
        leading.time_delta.reset();
        leading.fps = *sequence.lead_in_fps;
    }
    return [state = sequence.state, leading = std::move(leading),
            replay = std::move(replay)](int frame) mutable {
        render::FrameState seen = frame == state.frame ? state : leading.at_frame(frame);
        if (replay)
            replay->fill(seen);
        return seen;
    };
}

Result<Extent> parse_size(std::string_view text) {
    const auto extent = parse_extent(text);
    if (!extent)
        return fail(
            ErrorCode::usage,
            fmt::format("--size {}: give WIDTHxHEIGHT in pixels, both at least 1, as in 640x360", text));
    return *extent;
}

Result<std::vector<int>> parse_frames(std::string_view text) {
    std::vector<int> frames;
    std::string_view rest = text;
    bool good = take_range(rest, frames);
    while (good && consume(rest, ','))
        good = take_range(rest, frames);
    if (!good || !rest.empty())
        return fail(ErrorCode::usage,
                    fmt::format("--frames {}: give frames from 0 to {} as in 7, 0-29, 0-120x10 or 0-9,20-29",
                                text, render::k_last_frame));
    return frames;
}

Result<render::Mouse> parse_mouse(std::string_view text) {
    const bool down = text.ends_with(k_down);
    const auto at = numbers_from<double>(text.substr(0, text.size() - (down ? k_down.size() : 0)));
    const auto near = [](double pixel) { return std::abs(pixel) <= k_farthest_pixel; };
    if ((at.size() != 2 && at.size() != 4) || !std::ranges::all_of(at, near))
        return fail(ErrorCode::usage,
                    fmt::format("--mouse {}: give x,y for a click or x,y,from_x,from_y for a drag, in pixels "
                                "from the bottom left, and ,down while the button is pressed",
                                text));
    return at.size() == 4 ? render::Mouse::dragged({at[2], at[3]}, {at[0], at[1]}, down)
                          : render::Mouse::clicked({at[0], at[1]}, down);
}

Result<glm::ivec2> parse_pixel(std::string_view text, Extent extent) {
    const std::vector<int> at = numbers_from<int>(text);
    if (at.size() == 2 && Rectangle{0, 0, extent}.contains(at[0], at[1]))
        return glm::ivec2(at[0], at[1]);
    return fail(ErrorCode::usage, fmt::format("--pixel {}: give x,y from the bottom left, within {}x{}", text,
                                              extent.width, extent.height));
}

void add_scene_options(Command command, SceneRequest& request) {
    command
        .add_option(
            "SCENE", request.path,
            "A .glsl or .frag file with mainImage, a scene folder, ShaderToy's .json, or - for a text "
            "from standard input")
        .required()
        .check([&request](const std::string& path) { return read_scene_of_input(request, path); })
        .each(place_diagnostics);
    add_preset_option(command, request.path);
    command.add_option("--set", request.sets, "Value of a knob (#iUniform)")
        .type_name("NAME=VALUE")
        .repeatable();
    command.add_option("--define", request.defines, "Replaces a #define or const of the scene")
        .type_name("NAME=VALUE")
        .repeatable();
    command
        .add_option("--channel", request.channels,
                    "Input of iChannelN of Image or of PASS: a file, a name as in a directive (noise, "
                    "keyboard) or none; for tests: black, white, nan, texel")
        .type_name("[PASS:]N=FILE|noise|none")
        .repeatable();
    add_file_options(command, request);
}

void add_file_options(Command command, SceneRequest& request) {
    command
        .add_option("--media", request.files.media,
                    "Folder in which ShaderToy's media files are found by name")
        .type_name("DIR")
        .check(existing_folder());
    command.add_flag("--allow-outside", request.files.allow_outside,
                     "Lets the scene read files outside its folder");
}

void add_precision_options(Command command, SceneRequest& request) {
    const Option precision =
        command
            .add_option(
                "--precision", [&request](const std::string& text) { request.doubles = text == "double"; },
                "double: computes the scene in 64-bit floats [single]")
            .type_name("single|double")
            .check(one_of({"single", "double"}));
    command
        .add_flag("--double-hashes", request.double_hashes,
                  "Also computes hashes in 64-bit floats: other random numbers, so another picture")
        .needs(precision);
}

void add_device_options(Command command, DeviceChoice& device) {
    command
        .add_option("--device", device.name, "Device to draw with: a name from `tidemark inspect --devices`")
        .type_name("NAME")
        .check([](const std::string& name) -> std::string {
            return split_device_name(name).es ? "es: is for --devices of compare; capture and view have --es"
                                              : "";
        })
        .capture_default_str();
    command.add_flag("--require-gpu", device.gpu_only,
                     "Fails if the CPU would draw instead of a graphics card");
}

void add_number_options(Command command, FrameOptions& options, std::string_view option) {
    render::for_each_number([&](const auto& field) {
        if (!option.empty() && option != field.option)
            return;
        command
            .add_option(
                std::string(field.option),
                [&options, key = field.option](const std::string& text) {
                    options.numbers[key] = parse_number(key, text).value_or(0);
                },
                std::string(field.meaning))
            .type_name(std::string(field.placeholder))
            .check([key = field.option](const std::string& text) {
                return parse_number(key, text)
                           ? std::string()
                           : fmt::format("give a number{}, not '{}'",
                                         key == "--fps" ? " or a fraction as in 24000/1001" : "", text);
            })
            .default_str(fmt::format("{}", render::FrameState().*field.member));
    });
}

void add_picture_options(Command command, FrameOptions& options) {
    command
        .add_option("--size", options.size,
                    "Resolution in pixels; the default is the scene's #iSize, if it has one")
        .type_name("WxH")
        .default_str("640x360");
    add_number_options(command, options);
    command.add_option("--date", options.date, "iDate at iTime 0, as in 2024-12-31T23:59:58")
        .type_name("ISO");
    command
        .add_option("--camera", options.camera,
                    "Orbit camera of a scene that declares iCamera or iOrbit, in degrees")
        .type_name("AZIMUTH,ELEVATION,DISTANCE[,X,Y,Z]");
    command.add_option("--pass", options.pass, "Pass to show, as in \"Buffer A\" [Image]").type_name("NAME");
    command.add_option("--input", options.input, "Replays a recording of mouse and keyboard events")
        .type_name("FILE");
}

void add_time_options(Command command, FrameOptions& options) {
    const Option frame = command.add_option("--frame", options.frame, "One frame, from 0 (the default)")
                             .type_name("N")
                             .check(number<int>("a whole number"));
    const Option frames =
        command.add_option("--frames", options.frames, "Frames, inclusive, as in 0-29 or 0-120x10")
            .type_name("A-B[xS][,...]");
    const Option time = command.add_option("--time", options.time, "iTime in seconds, instead of a frame")
                            .type_name("T")
                            .check(number<double>("a number"));
    frame.excludes(frames).excludes(time);
    frames.excludes(time);
    command
        .add_option("--mouse", options.mouse,
                    "iMouse after a click at X,Y, or after a drag to it from FROM_X,FROM_Y; down: while the "
                    "button is pressed")
        .type_name("X,Y[,FROM_X,FROM_Y][,down]")
        .excludes("--input");
}

std::vector<std::filesystem::path> files_read(const scene::Scene& scene, const FrameOptions& options) {
    std::vector<std::filesystem::path> files = scene.files;
    files.push_back(scene.file);
    if (options.input)
        files.emplace_back(*options.input);
    return files;
}

FrameOptions sized(FrameOptions options, const scene::Scene& scene) {
    if (!options.size && scene.size)
        options.size = scene::to_string(*scene.size);
    return options;
}

FrameOptions sized(FrameOptions options, const SceneRequest& request) {
    const auto scene = options.size ? Result<scene::Scene>() : scene::load_scene(request.path, request.files);
    return scene ? sized(std::move(options), *scene) : options;
}

Result<FrameSequence> resolve(const FrameOptions& options, FrameSequence base) {
    FrameSequence sequence = std::move(base);
    render::FrameState& state = sequence.state;
    if (options.size) {
        const Extent before = state.extent;
        TRY(keep(parse_size(*options.size), state.extent));
        state.mouse.stretch(before, state.extent);
    }
    TRY(resolve_time(options, sequence));
    if (options.mouse)
        TRY(keep(parse_mouse(*options.mouse), state.mouse));
    if (options.date)
        TRY(keep(render::parse_date(*options.date), state.date));
    if (options.camera) {
        TRY(keep(render::parse_camera(*options.camera), state.camera));
        state.initial_camera = state.camera;
    }
    if (!options.pass.empty())
        state.pass = options.pass;
    if (options.input) {
        sequence.input_file = *options.input;
        TRY(keep(load_input_script(*options.input), sequence.input));
    }
    return sequence;
}

bool compiles_scenes(Command command) {
    return command.has_option("SCENE") && command.has_option("--set");
}

void add_memory_option(Command command, LimitOptions& options) {
    command.add_option("--memory", options.memory, "Memory limit for compiling and drawing, as in 2G [50%]")
        .type_name("SIZE");
}

void add_limit_options(Command app, LimitOptions& options) {
    for (Command command : app.subcommands()) {
        const bool compiles = compiles_scenes(command), compares = command.has_option("--devices");
        if (!(compiles || compares) || command.has_option("--memory")) // `view` adds its own
            continue;
        add_memory_option(command, options);
        if (compiles && !command.has_option("--timeout"))
            command
                .add_option(
                    "--timeout", options.timeout,
                    "Stops with exit code 5 when the driver takes longer to compile a pass or to draw")
                .type_name("SECONDS")
                .check(number<double>("a number of seconds"));
    }
}

Result<Limits> resolve(const LimitOptions& options) {
    if (options.timeout && !(*options.timeout > 0))
        return fail(ErrorCode::usage, "--timeout: give a number of seconds above 0");
    const uint64_t machine = machine_memory();
    if (!options.memory)
        return Limits{options.timeout, machine / 2};
    return parse_memory(*options.memory, machine).map([&](uint64_t bytes) {
        return Limits{options.timeout, bytes};
    });
}

} // namespace tidemark::host
