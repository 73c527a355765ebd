// `compare --devices A,B SCENE…`: draws scenes on two devices and says why they differ. Each device draws in
// a process of its own: a driver may crash, and a process can use one driver of Mesa only. The second device
// may be a browser, which draws the exported page.

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/file.hpp"
#include "cli/inspect.hpp"
#include "host/console.hpp"
#include "host/diagnostics.hpp"
#include "host/forked.hpp"
#include "host/gl_context.hpp"
#include "host/json.hpp"
#include "host/supervision.hpp"
#include "lab/device_difference.hpp"
#include "lab/report_page.hpp"
#include "media/comparison.hpp"
#include "media/file_samples.hpp"
#include "media/picture_file.hpp"
#include "web/page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace tidemark::cli {

using namespace host;
namespace {

namespace fs = std::filesystem;
using lab::DeviceCause;
using lab::DeviceDifference;
using lab::PassPicture;

/// A driver that needs longer for one scene hangs.
constexpr double k_patience_seconds = 120;

/// The result of a scene.
enum class Outcome { same, close, explained, unexplained, one_side, neither };

struct SceneOutcome {
    fs::path scene;
    Outcome outcome = Outcome::neither;
    DeviceDifference difference{};
    std::string problem_a{}, problem_b{}; ///< why a device does not draw it; empty: it does
    image::Image picture_a{}, picture_b{};
};

/// Memory that a child process writes and its parent reads.
class SharedBytes {
public:
    SharedBytes() : file_(::memfd_create("pictures", MFD_CLOEXEC)) {}
    SharedBytes(const SharedBytes&) = delete;
    SharedBytes& operator=(const SharedBytes&) = delete;
    ~SharedBytes() { ::close(file_); }

    bool append(std::span<const std::byte> bytes) const {
        while (!bytes.empty()) {
            const ssize_t written = ::write(file_, bytes.data(), bytes.size());
            if (written <= 0)
                return false;
            bytes = bytes.subspan(size_t(written));
        }
        return true;
    }

    bool read(size_t offset, std::span<std::byte> into) const {
        while (!into.empty()) {
            const ssize_t got = ::pread(file_, into.data(), into.size(), off_t(offset));
            if (got <= 0)
                return false;
            into = into.subspan(size_t(got));
            offset += size_t(got);
        }
        return true;
    }

private:
    int file_;
};

/// The pictures that a process drew, or why there are none.
struct Drawn {
    lab::FramePictures frame;
    std::string problem;
};

Json described(const PassPicture& pass, bool is_before) {
    const image::Image& picture = pass.picture;
    return {{"pass", pass.pass},
            {"before", is_before},
            {"width", picture.extent.width},
            {"height", picture.extent.height},
            {"channels", picture.channels}};
}

Json cause_json(const DeviceCause& cause) {
    Json places = Json::array();
    for (const SourceLocation& where : cause.places)
        places.push_back({{"file", where.file}, {"line", where.line}});
    return {{"cause", cause.name}, {"says", cause.says},   {"pass", cause.pass},
            {"places", places},    {"moved", cause.moved}, {"reproduced", cause.reproduced}};
}

DeviceCause cause_of(const Json& json) {
    DeviceCause cause{json.at("cause"), json.at("says"),      json.at("pass"), {},
                      json.at("moved"), json.at("reproduced")};
    for (const Json& where : json.at("places"))
        cause.places.push_back({where.at("file").get<std::string>(), where.at("line").get<int>()});
    return cause;
}

/// Returns why a child process ended early; empty: it did not.
std::string end_of(const ForkedResult& run) {
    return run.over_memory ? fmt::format("it takes more than {} of memory", memory_text(memory_of_a_part()))
                           : run.crash;
}

/// Draws a state on a device, in a child process; a scene with feedback is drawn from frame `first` on.
Result<Drawn> drawn_on(const std::string& device, const scene::Scene& scene, const render::FrameState& state,
                       int first) {
    const SharedBytes bytes;
    const auto draw = [&](const Tell& tell) -> Result<void> {
        const auto context = TRY(host::HeadlessContext::create({device}));
        lab::ProbeBench bench(scene, {});
        bench.start_at(first);
        const lab::FramePictures frame = TRY(lab::draw_frame(bench, state));
        for (const auto* const passes : {&frame.passes, &frame.before})
            for (const PassPicture& pass : *passes) {
                if (!bytes.append(pass.picture.bytes))
                    return fail(ErrorCode::no_memory, "no memory for the pictures");
                tell(dump(described(pass, passes == &frame.before)));
            }
        return {};
    };
    Drawn drawn;
    size_t offset = 0;
    const auto run = TRY(run_forked(
        [&](const Tell& tell) {
            if (const auto done = draw(tell); !done)
                tell(dump(Json{{"problem", to_string(done.error())}}));
        },
        {.seconds = k_patience_seconds, .memory = memory_of_a_part()},
        [&](std::string_view line) {
            const Json json = parse_json(line);
            if (json.contains("problem")) {
                drawn.problem = json.at("problem");
                return;
            }
            image::Image picture({json.at("width"), json.at("height")}, json.at("channels"),
                                 image::SampleType::f32);
            if (!bytes.read(offset, picture.bytes))
                drawn.problem = "its pictures are lost";
            offset += picture.bytes.size();
            (json.at("before") ? drawn.frame.before : drawn.frame.passes)
                .push_back({json.at("pass"), std::move(picture)});
        }));
    if (run.timed_out)
        drawn.problem = fmt::format("no picture within {:.0f} s", k_patience_seconds);
    else if (const std::string end = end_of(run); !end.empty())
        drawn.problem = end;
    return drawn;
}

/// Draws a state of the scene as an exported page. Starts the browser if it does not run.
Result<Drawn> drawn_in_browser(std::optional<web::Browser>& browser, const std::string& device,
                               const scene::Scene& scene, const render::FrameState& state, int first) {
    if (!browser)
        browser = TRY(web::Browser::start(device));
    const auto page = web::make_page(scene, web::PageForm::whole, run_numbers(state));
    if (!page)
        return Drawn{{}, to_string(page.error())};
    auto frame = browser->draw(*page, state, first, k_patience_seconds);
    if (frame)
        return Drawn{*std::move(frame), {}};
    browser.reset(); // it may be busy, or broken
    return Drawn{{},
                 frame.error().code == ErrorCode::timed_out
                     ? fmt::format("no picture within {:.0f} s", k_patience_seconds)
                     : frame.error().message};
}

/// "pictures:FOLDER" is a device that drew the pictures of the folder, one with the name of each scene.
constexpr std::string_view k_pictures_prefix = "pictures:";

scene::Scene scene_of_text(std::string_view text) {
    scene::Scene scene;
    scene.file = "test.glsl";
    scene.passes.resize(1);
    scene.passes[0].text.append(std::string(text), "test.glsl", 1);
    return scene;
}

/// Returns whether both devices compute functions with the same bits.
Result<bool> have_same_functions(const std::array<std::string, 2>& devices) {
    const render::FrameState state{.extent = lab::k_functions_extent};
    const scene::Scene scene = scene_of_text(lab::k_functions_test);
    const Drawn here = TRY(drawn_on(devices[0], scene, state, 0)),
                there = TRY(drawn_on(devices[1], scene, state, 0));
    return here.problem.empty() && there.problem.empty() &&
           here.frame.passes[0].picture.bytes == there.frame.passes[0].picture.bytes;
}

/// Returns what is known of the second device's driver, by what it draws.
Result<lab::OtherDevice> other_device(std::optional<web::Browser>& browser,
                                      const std::array<std::string, 2>& devices) {
    if (devices[1].starts_with(k_pictures_prefix))
        return lab::OtherDevice::unknown;
    if (!web::is_browser(devices[1]))
        return TRY(have_same_functions(devices)) ? lab::OtherDevice::same_functions
                                                 : lab::OtherDevice::unknown;
    const render::FrameState state{.extent = {1, 1}};
    const Drawn drawn =
        TRY(drawn_in_browser(browser, devices[1], scene_of_text(lab::k_swiftshader_test), state, 0));
    const bool white = !drawn.frame.passes.empty() && drawn.frame.passes[0].picture.f32()[0] > 0.5f;
    return white ? lab::OtherDevice::swiftshader : lab::OtherDevice::unknown;
}

Drawn found_in(const fs::path& folder, const fs::path& path, const scene::Scene& scene, Extent extent) {
    std::error_code ignored;
    for (const char* const ending : {".png", ".exr", ".tif", ".jpg"}) {
        const fs::path file = folder / (path.stem().string() + ending);
        if (!fs::exists(file, ignored))
            continue;
        const auto picture = image::read_picture(file);
        if (!picture)
            return {{}, to_string(picture.error())};
        if (picture->extent != extent)
            return {{},
                    fmt::format("'{}' has {}x{} pixels: give --size {}x{}", file.string(),
                                picture->extent.width, picture->extent.height, picture->extent.width,
                                picture->extent.height)};
        Drawn drawn;
        drawn.frame.passes.push_back(
            {scene.image().name, image::with_channels(image::in_floats(*picture), 4)});
        return drawn;
    }
    return {
        {},
        fmt::format("'{}' has no picture {}.png (.exr .tif .jpg)", folder.string(), path.stem().string())};
}

/// Draws the scene, of the file `path`, on the second device.
Result<Drawn> drawn_there(const DevicesRequest& request, std::optional<web::Browser>& browser,
                          const scene::Scene& scene, const fs::path& path, int first) {
    const std::string& device = request.devices[1];
    const render::FrameState& state = request.sequence.state;
    if (device.starts_with(k_pictures_prefix))
        return found_in(device.substr(k_pictures_prefix.size()), path, scene, state.extent);
    return web::is_browser(device) ? drawn_in_browser(browser, device, scene, state, first)
                                   : drawn_on(device, scene, state, first);
}

const image::Image& image_of(const scene::Scene& scene, const std::vector<PassPicture>& passes) {
    return std::ranges::find(passes, scene.image().name, &PassPicture::pass)->picture;
}

/// Finds the causes of a difference on the first device, in a child process.
Result<void> explain_apart(DeviceDifference& difference, const std::string& device, const scene::Scene& scene,
                           const render::FrameState& state, int first, const lab::FramePictures& there,
                           lab::OtherDevice other) {
    const auto json_of = [](const DeviceDifference& found) {
        Json causes = Json::array();
        for (const DeviceCause& cause : found.causes)
            causes.push_back(cause_json(cause));
        return dump(Json{{"explained", found.explained},
                         {"left_out", found.problem},
                         {"too_slow", found.too_slow},
                         {"begins_earlier", found.begins_earlier},
                         {"causes", causes}});
    };
    const auto explain = [&](DeviceDifference& found, const Tell& tell) -> Result<void> {
        host::compile_for_few_drawings();
        const auto context = TRY(host::HeadlessContext::create({device}));
        lab::ProbeBench bench(scene, {});
        bench.start_at(first);
        return lab::explain(found, bench, state, there, other,
                            [&](const DeviceDifference& so_far) { tell(json_of(so_far)); });
    };
    const auto run = TRY(run_forked(
        [&](const Tell& tell) {
            DeviceDifference found;
            if (const auto done = explain(found, tell); !done)
                found = {.problem = to_string(done.error())};
            tell(json_of(found));
        },
        {.seconds = k_patience_seconds, .memory = memory_of_a_part()},
        [&](std::string_view line) {
            const Json json = parse_json(line);
            difference.explained = json.at("explained");
            difference.problem = json.at("left_out");
            difference.too_slow = json.at("too_slow");
            difference.begins_earlier = json.at("begins_earlier");
            difference.causes.clear();
            for (const Json& cause : json.at("causes"))
                difference.causes.push_back(cause_of(cause));
        }));
    if (run.timed_out && difference.explained < lab::k_explained_share)
        difference.problem = fmt::format("causes were searched for {:.0f} s only", k_patience_seconds);
    else if (const std::string end = end_of(run); !end.empty())
        difference.problem = end;
    return {};
}

/// Returns whether a pass, Image or a buffer, differs between two devices.
bool differ(const scene::Scene& scene, const lab::FramePictures& here, const lab::FramePictures& there) {
    return std::ranges::any_of(here.passes, [&](const PassPicture& pass) {
        const bool is_image = pass.pass == scene.image().name;
        const auto kind = is_image ? lab::PictureKind::image : lab::PictureKind::buffer;
        const image::Image* const other = lab::picture_of(there.passes, pass.pass);
        return other && other->extent == pass.picture.extent &&
               lab::count(lab::differing(pass.picture, *other, lab::same_pixel(kind), kind)) > 0;
    });
}

/// Finds the causes at the frame at which the devices begin to differ: they draw the frame before it alike.
Result<void> explain_beginning(const DevicesRequest& request, std::optional<web::Browser>& browser,
                               DeviceDifference& difference, const scene::Scene& scene, const fs::path& path,
                               lab::OtherDevice other) {
    const render::FrameState& last = request.sequence.state;
    const int first = lab::first_frame_of(last);
    DevicesRequest earlier = request;
    lab::FramePictures found; // of the second device in frame `unlike`
    for (int same = first - 1, unlike = last.frame; unlike - same > 1;) {
        const render::FrameState state = last.at_frame(same + (unlike - same) / 2);
        earlier.sequence.state = state;
        const Drawn here = TRY(drawn_on(request.devices[0], scene, state, first));
        Drawn there = TRY(drawn_there(earlier, browser, scene, path, first));
        if (!here.problem.empty() || !there.problem.empty())
            return {};
        if (differ(scene, here.frame, there.frame)) {
            unlike = state.frame;
            difference.frame = unlike;
            found = std::move(there.frame);
        } else {
            same = state.frame;
        }
    }
    if (difference.frame)
        return explain_apart(difference, request.devices[0], scene, last.at_frame(*difference.frame), first,
                             found, other);
    difference.problem = "no frame before differs visibly; later ones amplify what is too small to be seen";
    return {};
}

/// Finds the causes; where that takes too long, in pictures of half the width and height, and again half.
Result<void> explain_in_time(const DevicesRequest& request, std::optional<web::Browser>& browser,
                             DeviceDifference& difference, const scene::Scene& scene, const fs::path& path,
                             lab::FramePictures there, lab::OtherDevice other) {
    DevicesRequest smaller = request;
    Extent& extent = smaller.sequence.state.extent;
    for (;;) {
        const int first = lab::first_frame_of(smaller.sequence.state);
        TRY(explain_apart(difference, request.devices[0], scene, smaller.sequence.state, first, there,
                          other));
        if (difference.begins_earlier)
            return explain_beginning(smaller, browser, difference, scene, path, other);
        if (!difference.too_slow || request.devices[1].starts_with(k_pictures_prefix))
            return {};
        extent = {extent.width / 2, extent.height / 2};
        if (std::min(extent.width, extent.height) < 1)
            return {};
        Drawn drawn = TRY(drawn_there(smaller, browser, scene, path, first));
        if (!drawn.problem.empty())
            return {};
        there = std::move(drawn.frame);
        difference.examined = extent;
    }
}

Result<SceneOutcome> outcome_of(const DevicesRequest& request, std::optional<web::Browser>& browser,
                                std::optional<lab::OtherDevice>& other, const fs::path& path) {
    SceneOutcome result{path};
    SceneRequest scene_request = request.scene;
    scene_request.path = path;
    const auto scene = load(scene_request, request.sequence);
    if (!scene) {
        result.problem_a = result.problem_b = to_string(scene.error());
        return result;
    }
    const render::FrameState& state = request.sequence.state;
    const int first = lab::first_frame_of(state);
    const Drawn here = TRY(drawn_on(request.devices[0], *scene, state, first));
    const Drawn there = TRY(drawn_there(request, browser, *scene, path, first));
    result.problem_a = here.problem;
    result.problem_b = there.problem;
    if (!here.problem.empty() || !there.problem.empty()) {
        result.outcome = here.problem.empty() != there.problem.empty() ? Outcome::one_side : Outcome::neither;
        return result;
    }
    result.picture_a = image_of(*scene, here.frame.passes);
    result.picture_b = image_of(*scene, there.frame.passes);
    result.difference = TRY(lab::compare_devices(result.picture_a, result.picture_b));
    if (result.difference.differing == 0) {
        result.outcome = result.difference.equal ? Outcome::same : Outcome::close;
        return result;
    }
    if (!other) // asked once, when the first scene differs
        other = TRY(other_device(browser, request.devices));
    TRY(explain_in_time(request, browser, result.difference, *scene, path, there.frame, *other));
    result.outcome =
        result.difference.explained >= lab::k_explained_share ? Outcome::explained : Outcome::unexplained;
    return result;
}

std::string_view name_of(Outcome outcome) {
    constexpr std::string_view k_names[] = {"same",        "within one level", "explained",
                                            "unexplained", "one side only",    "neither"};
    return k_names[size_t(outcome)];
}

std::string places_of(const DeviceCause& cause) {
    std::vector<std::string> places;
    for (const SourceLocation& where : cause.places)
        places.push_back(fmt::format("{}:{}", where.file, where.line));
    return places.empty() ? "" : fmt::format(" at {}", fmt::join(places, ", "));
}

std::string words_for(const DeviceCause& cause) {
    return fmt::format("{}{}: {} ({:.0f} % of those pixels)", cause.name, places_of(cause), cause.says,
                       100 * cause.moved);
}

std::string numbers_of(const DeviceDifference& difference) {
    std::string text =
        fmt::format("{:.3g} % of the pixels differ, by {:.0f} of 255 at most; FLIP {:.3g}, PSNR {:.1f} dB",
                    100.0 * double(difference.differing) / double(difference.pixels),
                    255 * difference.largest, difference.flip, difference.psnr);
    if (difference.not_finite_here + difference.not_finite_there > 0)
        text += fmt::format("; NaN or infinite on one device only: {} and {} pixels",
                            difference.not_finite_here, difference.not_finite_there);
    return text;
}

std::string text_of(const DevicesRequest& request, const SceneOutcome& scene) {
    std::string text = fmt::format("{}: {}\n", scene.scene.string(), name_of(scene.outcome));
    if (scene.outcome == Outcome::explained || scene.outcome == Outcome::unexplained) {
        text += fmt::format("  {}\n", numbers_of(scene.difference));
        for (const DeviceCause& cause : scene.difference.causes)
            text += fmt::format("  {}\n", words_for(cause));
        if (const Extent size = scene.difference.examined; size.width > 0)
            text += fmt::format("  examined at {}x{}: a frame takes long\n", size.width, size.height);
        if (scene.difference.frame)
            text += fmt::format("  examined in frame {}, the first that differs\n", *scene.difference.frame);
        if (scene.outcome == Outcome::unexplained && !scene.difference.problem.empty())
            text += fmt::format("  left out: {}\n", scene.difference.problem);
    }
    for (const auto& [device, problem] :
         {std::pair(request.devices[0], scene.problem_a), std::pair(request.devices[1], scene.problem_b)})
        if (!problem.empty())
            text += fmt::format("  {}: {}\n", device, problem);
    return text;
}

Json json_of(const DevicesRequest& request, const SceneOutcome& scene) {
    Json json = {{"scene", scene.scene.string()}, {"verdict", name_of(scene.outcome)}};
    if (scene.problem_a.empty() && scene.problem_b.empty()) {
        const DeviceDifference& found = scene.difference;
        json.update({{"pixels", found.pixels},
                     {"differing", found.differing},
                     {"largest", found.largest},
                     {"psnr", std::isfinite(found.psnr) ? Json(found.psnr) : Json(nullptr)},
                     {"flip", found.flip},
                     {"non_finite", {found.not_finite_here, found.not_finite_there}},
                     {"explained", found.explained},
                     {"causes", Json::array()}});
        for (const DeviceCause& cause : found.causes)
            json["causes"].push_back(cause_json(cause));
        if (!found.problem.empty())
            json["left_out"] = found.problem;
        if (found.examined.width > 0)
            json["examined"] = {found.examined.width, found.examined.height};
        if (found.frame)
            json["examined_frame"] = *found.frame;
    }
    if (!scene.problem_a.empty())
        json["problems"][request.devices[0]] = scene.problem_a;
    if (!scene.problem_b.empty())
        json["problems"][request.devices[1]] = scene.problem_b;
    return json;
}

/// A cause as a warning at its first line, for editors and SARIF.
void say_differences(const DevicesRequest& request, const SceneOutcome& scene) {
    for (const DeviceCause& cause : scene.difference.causes) {
        Diagnostic diagnostic;
        diagnostic.severity = Severity::warning;
        diagnostic.where = cause.places.empty() ? SourceLocation{scene.scene.string(), 1} : cause.places[0];
        diagnostic.message = fmt::format(
            "{} and {} draw {:.3g} % of the pixels differently: {}", request.devices[0], request.devices[1],
            100.0 * double(scene.difference.differing) / double(scene.difference.pixels), cause.says);
        say(finding_of(std::move(diagnostic), {cause.name, "what other devices compute differently"}));
    }
}

// The page: a comparison with a divider, and for each scene that differs what was found.

Result<std::string> figure(const OutputPath& folder, const std::string& file, const std::string& name,
                           const image::Image& picture) {
    const OutputPath path = folder / file;
    TRY(image::write_picture(path, picture, {image::SampleDepth::u8}));
    const std::string bytes = TRY(read_file(path.path()));
    return fmt::format("<figure><img src=\"data:image/png;base64,{}\" alt=\"{}\" data-name=\"{}\">"
                       "<figcaption>{}</figcaption></figure>\n",
                       base64(bytes), report::escaped(name), report::escaped(name), report::escaped(name));
}

Result<void> write_page(const DevicesRequest& request, const std::vector<SceneOutcome>& outcomes,
                        const std::string& summary) {
    const OutputPath folder = OutputPath::typed(request.output).sparing(request.scenes);
    std::string figures, articles, rows;
    for (size_t i = 0; i < outcomes.size(); ++i) {
        const SceneOutcome& scene = outcomes[i];
        const std::string name = scene.scene.filename().string();
        rows +=
            fmt::format("<tr><td>{}</td><td>{}</td></tr>\n", report::escaped(name), name_of(scene.outcome));
        if (scene.outcome != Outcome::explained && scene.outcome != Outcome::unexplained)
            continue;
        const std::string file = fmt::format("{:03}-{}", i + 1, scene.scene.stem().string());
        for (const auto& [side, picture] : {std::pair(0, &scene.picture_a), std::pair(1, &scene.picture_b)})
            figures += TRY(figure(folder, fmt::format("{}-{}.png", file, "ab"[side]),
                                  fmt::format("{}, {}", name, request.devices[size_t(side)]), *picture));
        const std::string difference =
            TRY(figure(folder, file + "-difference.png", name + ", difference times 8",
                       image::difference_picture(scene.picture_a, scene.picture_b, 8)));
        articles += fmt::format("<article class=\"finding pictured\">\n<div><h3>{}: {}</h3>\n<p>{}</p>\n",
                                report::escaped(name), name_of(scene.outcome),
                                report::escaped(numbers_of(scene.difference)));
        for (const DeviceCause& cause : scene.difference.causes)
            articles += fmt::format("<p>{}</p>\n", report::escaped(words_for(cause)));
        articles += fmt::format("</div>\n<div>{}</div></article>\n", difference);
    }
    std::string body;
    if (!figures.empty())
        body += report::comparison_form("Every scene that differs, on both devices.", figures);
    body += articles + report::table("scenes", "<tr><th>Scene</th><th>Result</th></tr>\n" + rows);
    const std::string title = fmt::format("{} and {}", request.devices[0], request.devices[1]);
    const OutputPath page = folder / "index.html";
    TRY(write_file(page, report::make_page({title + ": what they draw differently", title, summary, body})));
    say(fmt::format("wrote {}", page.string()));
    return {};
}

} // namespace

Result<int> compare_on_devices(const DevicesRequest& request) {
    Json json = {{"tidemark", k_version}, {"devices", request.devices}, {"scenes", Json::array()}};
    std::map<Outcome, int> counts;
    std::vector<SceneOutcome> outcomes;
    std::optional<web::Browser> browser;
    std::optional<lab::OtherDevice> other;
    if (const std::string& first = request.devices[0];
        web::is_browser(first) || split_device_name(first).es || first.starts_with(k_pictures_prefix))
        return fail(
            ErrorCode::usage,
            fmt::format("--devices: name {} second: causes are tried out on the first, with OpenGL 4.5",
                        request.devices[0]));
    if (!request.output.empty()) // before the scenes, whose time would be lost if the folder cannot be made
        TRY(make_folder(OutputPath::typed(request.output)));
    for (const fs::path& path : request.scenes) {
        SceneOutcome outcome = TRY(outcome_of(request, browser, other, path));
        ++counts[outcome.outcome];
        json["scenes"].push_back(json_of(request, outcome));
        if (!request.json)
            TRY(put(text_of(request, outcome)));
        if (findings_are_diagnostics())
            say_differences(request, outcome);
        if (request.output.empty()) // only the page needs them later
            outcome.picture_a = outcome.picture_b = {};
        outcomes.push_back(std::move(outcome));
    }
    std::vector<std::string> words;
    for (const auto& [outcome, number] : counts)
        words.push_back(fmt::format("{} {}", number, name_of(outcome)));
    const std::string summary = fmt::format("{} scene{}: {}", request.scenes.size(),
                                            request.scenes.size() == 1 ? "" : "s", fmt::join(words, ", "));
    if (request.json)
        TRY(put(dump(json, 2) + "\n"));
    else if (request.scenes.size() > 1)
        TRY(put(summary + "\n"));
    if (!request.output.empty())
        TRY(write_page(request, outcomes, summary));
    const int failed = counts[Outcome::unexplained] + counts[Outcome::one_side] + counts[Outcome::neither];
    return failed > 0 ? exit_code(ErrorCode::check_failed) : 0;
}

} // namespace tidemark::cli
