// Starts headless Chromium and controls it through a pipe (the DevTools protocol: one JSON object and a NUL a
// message). Draws an exported page's passes into float textures and reads them back.

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/folders.hpp"
#include "base/process.hpp"
#include "base/supervision.hpp"
#include "host/json.hpp"
#include "web/page.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <span>
#include <sstream>
#include <thread>
#include <utility>

namespace tidemark::web {
namespace {

/// Chromium's choice of a driver: its name as a device, and the options that select it.
struct BrowserDriver {
    std::string_view name;
    std::vector<std::string> options;
};

const std::array<BrowserDriver, 3>& browser_drivers() {
    static const std::array<BrowserDriver, 3> drivers{
        {{"chromium", {"--enable-unsafe-swiftshader"}},
         {"chromium:swiftshader",
          {"--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"}},
         {"chromium:egl", {"--use-gl=angle", "--use-angle=gl-egl"}}}};
    return drivers;
}

constexpr std::string_view k_programs[] = {"chromium", "chromium-browser", "google-chrome"};

bool is_in_path(std::string_view program) {
    const char* const path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (::access(fmt::format("{}/{}", folder, program).c_str(), X_OK) == 0)
            return true;
    return false;
}

/// Draws frames in the page's own renderer, with Image in floats, and returns every pass but cubemaps; with
/// feedback also those of the previous frame.
constexpr std::string_view k_draw = R"((async asked => {
    const div = document.querySelector(".tidemark");
    while (!["running", "failed"].includes(div.dataset.state))
        await new Promise(resolve => setTimeout(resolve, 5));
    if (div.dataset.state === "failed")
        return {problem: div.querySelector(".tidemark-message").textContent};
    const {renderer, mouse, keyboard, camera, scene: {knobs, passes}} = div.tidemark, {gl} = renderer;
    Object.assign(renderer.image.target, {format: gl.RGBA32F, size: null});
    renderer.resize(...asked.size);
    renderer.restart();
    const names = passes.filter(pass => pass.kind !== "sound").map(pass => pass.name);
    const pictures = () => renderer.passes.flatMap((pass, i) => {
        if (pass.kind === "cubemap")
            return [];
        const [width, height] = pass.target.size, samples = new Float32Array(4 * width * height);
        gl.bindFramebuffer(gl.READ_FRAMEBUFFER, pass.target.latest.faces[0]);
        gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, samples);
        const bytes = new Uint8Array(samples.buffer), part = 1 << 15;
        let text = "";
        for (let at = 0; at < bytes.length; at += part)
            text += String.fromCharCode(...bytes.subarray(at, at + part));
        return [{pass: names[i], width, height, samples: btoa(text)}];
    });
    const draw = moment => renderer.draw({...moment, mouse, keyboard, camera, knobs});
    if (renderer.hasFeedback)
        asked.frames.slice(0, -1).forEach(draw);
    const before = renderer.hasFeedback ? pictures() : [];
    draw(asked.frames.at(-1));
    return gl.isContextLost() ? {problem: "the graphics driver was reset"} : {pictures: pictures(), before};
}))";

/// Fills `bytes` from base64 text without blanks; returns whether there were exactly as many.
bool from_base64(std::string_view text, std::span<std::byte> bytes) {
    constexpr std::string_view k_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    static const std::array<int8_t, 256> values = [&] {
        std::array<int8_t, 256> table{};
        table.fill(-1);
        for (size_t i = 0; i < k_digits.size(); ++i)
            table[uint8_t(k_digits[i])] = int8_t(i);
        return table;
    }();
    uint32_t bits = 0;
    int count = 0;
    size_t filled = 0;
    for (const char digit : text) {
        const int8_t value = values[uint8_t(digit)];
        if (value < 0)
            break; // the padding
        bits = bits << 6 | uint32_t(value);
        count += 6;
        if (count < 8)
            continue;
        count -= 8;
        if (filled == bytes.size())
            return false;
        bytes[filled++] = std::byte(bits >> count & 0xff);
    }
    return filled == bytes.size();
}

using Clock = std::chrono::steady_clock;

/// Returns a descriptor above those that the browser uses, which the program that is started does not get.
int moved_up(int file) {
    const int moved = ::fcntl(file, F_DUPFD_CLOEXEC, 10);
    ::close(file);
    return moved;
}

Json frames_json(const render::FrameState& state, int first) {
    Json frames = Json::array();
    for (int frame = first; frame <= state.frame; ++frame) {
        const render::FrameInputs inputs = render::inputs_of(state.at_frame(frame));
        frames.push_back(
            {{"frame", frame},
             {"time", inputs.time},
             {"delta", inputs.time_delta},
             {"rate", inputs.frame_rate},
             {"date", {inputs.date.year, inputs.date.month, inputs.date.day, inputs.date.seconds}}});
    }
    return {{"size", {state.extent.width, state.extent.height}}, {"frames", std::move(frames)}};
}

} // namespace

bool is_browser(std::string_view device) {
    return std::ranges::count(browser_drivers(), device, &BrowserDriver::name) > 0;
}

std::vector<std::string> usable_browsers() {
    std::vector<std::string> names;
    if (std::ranges::any_of(k_programs, is_in_path))
        for (const BrowserDriver& driver : browser_drivers())
            names.emplace_back(driver.name);
    return names;
}

/// The running program and the pipe to it.
struct Browser::State {
    ScratchFolder folder{}; ///< its profile and the page
    pid_t child = -1;
    int to_child = -1, from_child = -1;
    Leftover leftover{};
    std::string received{};
    int number = 0; ///< of the last message

    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State() {
        for (const int file : {to_child, from_child})
            if (file >= 0)
                ::close(file); // a browser without its pipe ends by itself
        if (child < 0)
            return;
        constexpr int k_steps = 200;
        for (int step = 0; step < k_steps; ++step) {
            if (::waitpid(child, nullptr, WNOHANG) == child)
                return;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        ::kill(-child, SIGKILL);
        ::waitpid(child, nullptr, 0);
    }

    Result<void> start(const BrowserDriver& driver);
    Result<Json> next(Clock::time_point deadline);
    Result<Json> call(std::string_view method, const Json& parameters, Clock::time_point deadline,
                      const std::string& session = {});
    Result<Json> evaluate(const std::string& script, const std::string& session, Clock::time_point deadline);
    Result<lab::FramePictures> draw(const std::string& session, const Json& asked,
                                    Clock::time_point deadline);
};

Result<void> Browser::State::start(const BrowserDriver& driver) {
    int down[2], up[2];
    if (folder.path().empty() || ::pipe(down) != 0 || ::pipe(up) != 0)
        return fail(ErrorCode::no_context, "cannot make a folder and a pipe for Chromium");
    const int reads = moved_up(down[0]), writes = moved_up(up[1]);
    to_child = moved_up(down[1]);
    from_child = moved_up(up[0]);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, reads, 3); // --remote-debugging-pipe: it reads 3 and writes 4
    posix_spawn_file_actions_adddup2(&files, writes, 4);
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&files, descriptor, "/dev/null", O_RDWR, 0);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
    int error = ENOENT;
    for (const std::string_view program : k_programs) {
        std::vector<std::string> words{std::string(program),
                                       "--headless",
                                       "--no-first-run",
                                       "--ignore-gpu-blocklist",
                                       "--disable-gpu-watchdog",
                                       "--disable-background-networking",
                                       "--disable-component-update",
                                       "--disable-sync",
                                       "--disable-breakpad",
                                       "--remote-debugging-pipe",
                                       "--user-data-dir=" + (folder.path() / "profile").string()};
        words.insert(words.end(), driver.options.begin(), driver.options.end());
        if (::geteuid() == 0) // Chromium has no sandbox for root
            words.emplace_back("--no-sandbox");
        words.emplace_back("about:blank");
        const std::vector<char*> arguments = argument_pointers(words);
        error = ::posix_spawnp(&child, arguments[0], &files, &attributes, arguments.data(), environ);
        if (error != ENOENT)
            break;
    }
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    ::close(reads);
    ::close(writes);
    if (error != 0) {
        child = -1;
        return fail(ErrorCode::no_context,
                    error == ENOENT ? "there is no Chromium: install Debian's package chromium"
                                    : fmt::format("Chromium does not start: {}", std::strerror(error)));
    }
    leftover = Leftover::child(child);
    return {};
}

/// Returns the next message of the browser.
Result<Json> Browser::State::next(Clock::time_point deadline) {
    size_t searched = 0;
    for (;;) {
        if (const size_t end = received.find('\0', searched); end != received.npos) {
            Json message = host::parse_or_discard(std::string_view(received).substr(0, end));
            received.erase(0, end + 1);
            return message;
        }
        searched = received.size();
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
        pollfd wait{from_child, POLLIN, 0};
        if (left <= 0 || ::poll(&wait, 1, int(left)) == 0)
            return fail(ErrorCode::timed_out, "Chromium does not answer in time");
        std::array<char, 1 << 16> part;
        const ssize_t got = ::read(from_child, part.data(), part.size());
        if (got <= 0)
            return fail(ErrorCode::no_context, "Chromium ended");
        received.append(part.data(), size_t(got));
    }
}

/// Sends a request and returns its result; the session is that of a page.
Result<Json> Browser::State::call(std::string_view method, const Json& parameters, Clock::time_point deadline,
                                  const std::string& session) {
    Json message = {{"id", ++number}, {"method", method}, {"params", parameters}};
    if (!session.empty())
        message["sessionId"] = session;
    const std::string text = host::dump(message) + '\0';
    if (write_all(to_child, std::as_bytes(std::span(text))) != 0)
        return fail(ErrorCode::no_context, "Chromium ended");
    for (;;) {
        const Json answer = TRY(next(deadline));
        if (!answer.is_object())
            return fail(ErrorCode::no_context, "Chromium answers in another language than this version");
        if (answer.value("method", "") == "Inspector.targetCrashed")
            return fail(ErrorCode::no_context, "the page crashed");
        if (answer.value("id", 0) != number)
            continue;
        if (answer.contains("error"))
            return fail(ErrorCode::no_context,
                        fmt::format("{}: {}", method, answer["error"].value("message", "refused")));
        return answer.value("result", Json::object());
    }
}

/// Returns the value of a script, awaited.
Result<Json> Browser::State::evaluate(const std::string& script, const std::string& session,
                                      Clock::time_point deadline) {
    const Json done = TRY(call("Runtime.evaluate",
                               {{"expression", script}, {"awaitPromise", true}, {"returnByValue", true}},
                               deadline, session));
    if (done.contains("exceptionDetails"))
        return fail(ErrorCode::no_context,
                    done["exceptionDetails"].value(Json::json_pointer("/exception/description"),
                                                   std::string("the page's script failed")));
    return done.value(Json::json_pointer("/result/value"), Json());
}

Result<lab::FramePictures> Browser::State::draw(const std::string& session, const Json& asked,
                                                Clock::time_point deadline) {
    TRY(call("Inspector.enable", Json::object(), deadline, session));
    // A page that is loading may lose a script that was begun, so the loading is waited for.
    for (;;) {
        const auto loaded = evaluate("location.protocol === 'file:' && document.readyState === 'complete'",
                                     session, deadline);
        if (loaded && *loaded == true)
            break;
        if (!loaded && Clock::now() > deadline)
            return fail(loaded.error());
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    const Json drawn = TRY(evaluate(fmt::format("{}({})", k_draw, host::dump(asked)), session, deadline));
    if (drawn.contains("problem"))
        return fail(ErrorCode::no_context, drawn["problem"].get<std::string>());
    lab::FramePictures frame;
    for (const auto& [pictures, name] : {std::pair(&frame.passes, "pictures"), {&frame.before, "before"}})
        for (const Json& pass : drawn.at(name)) {
            image::Image picture({pass.at("width"), pass.at("height")}, 4, image::SampleType::f32);
            if (!from_base64(pass.at("samples").get_ref<const std::string&>(), picture.bytes))
                return fail(ErrorCode::no_context, "the page's pictures are damaged");
            pictures->push_back({pass.at("pass"), std::move(picture)});
        }
    return frame;
}

Browser::Browser(std::unique_ptr<State> state) : state_(std::move(state)) {}
Browser::Browser(Browser&&) noexcept = default;
Browser& Browser::operator=(Browser&&) noexcept = default;
Browser::~Browser() = default;

Result<Browser> Browser::start(std::string_view device) {
    auto state = std::make_unique<State>();
    TRY(state->start(*std::ranges::find(browser_drivers(), device, &BrowserDriver::name)));
    return Browser(std::move(state));
}

Result<lab::FramePictures> Browser::draw(const std::string& page, const render::FrameState& state, int first,
                                         double seconds) {
    const auto deadline =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    const std::filesystem::path file = state_->folder.path() / "scene.html";
    TRY(write_file(OutputPath::typed(file), page));
    const std::string address =
        fmt::format("file://{}#paused&size={}x{}", file.string(), state.extent.width, state.extent.height);
    try {
        const Json target = TRY(state_->call("Target.createTarget", {{"url", address}}, deadline));
        const Json id = {{"targetId", target.at("targetId")}};
        Json attached = id;
        attached["flatten"] = true;
        const std::string session =
            TRY(state_->call("Target.attachToTarget", attached, deadline)).at("sessionId");
        auto pictures = state_->draw(session, frames_json(state, first), deadline);
        if (pictures || pictures.error().code != ErrorCode::timed_out)
            TRY(state_->call("Target.closeTarget", id, deadline));
        return pictures;
    } catch (const Json::exception& error) {
        return fail(ErrorCode::no_context, fmt::format("Chromium answers unexpectedly: {}", error.what()));
    }
}

} // namespace tidemark::web
