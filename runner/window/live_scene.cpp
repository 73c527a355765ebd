#include "window/live_scene.hpp"

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/mapped_text.hpp"
#include "host/console.hpp"
#include "host/diagnostics.hpp"
#include "host/json.hpp"
#include "scene/load_scene.hpp"
#include "scene/scene.hpp"
#include "shader/definitions.hpp"
#include "window/screen.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <ctime>
#include <map>
#include <span>

namespace tidemark::window {

using namespace host;
namespace fs = std::filesystem;
namespace {

constexpr std::string_view k_set = "--set";
constexpr std::string_view k_define = "--define";

bool is_edited(const HeldValue& held, const std::vector<HeldValue>& before) {
    const auto known =
        std::ranges::find_if(before, [&](const HeldValue& other) { return held.is_of(other); });
    return known != before.end() && known->in_file != held.in_file;
}

/// Returns whether `NAME=VALUE` sets that name.
bool names(std::string_view setting, std::string_view name) {
    const auto split = scene::split_setting(setting, k_set);
    return split && split->first == name;
}

/// Time in which a scene that does not load may still be half saved. It is longer than an editor's pause
/// between two writes, and short for a person.
constexpr double k_half_written_seconds = 0.06;

/// The kernel's tick, which is the resolution of file times.
constexpr double k_tick_seconds = 0.02;

double seconds_of(const timespec& time) {
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

double file_clock_seconds() {
    timespec now{};
    ::clock_gettime(CLOCK_REALTIME, &now);
    return seconds_of(now);
}

/// Returns whether the file was written, or moved into place, since `file_clock` or up to one tick before.
bool touched_since(const fs::path& file, double file_clock) {
    struct stat status {};
    return ::stat(file.c_str(), &status) == 0 && seconds_of(status.st_ctim) >= file_clock - k_tick_seconds;
}

/// Returns whether saving a file cannot fix the error.
bool is_final(const Error& error) {
    return error.code == ErrorCode::usage || error.code == ErrorCode::no_memory ||
           error.code == ErrorCode::no_context;
}

} // namespace

std::vector<HeldValue> held_values(const SceneRequest& request, const scene::Scene& scene) {
    std::vector<HeldValue> held;
    const auto hold = [&held](std::string_view option, const auto& setting, std::string in_file) {
        held.push_back({option, std::string(setting.first), std::string(setting.second), std::move(in_file)});
    };
    for (const std::string& text : request.sets)
        if (const auto setting = scene::split_setting(text, k_set))
            for (const scene::Knob& knob : scene.knobs)
                if (knob.name == setting->first)
                    hold(k_set, *setting, to_string(knob, knob.initial));
    for (const std::string& text : request.defines)
        if (const auto setting = scene::split_setting(text, k_define))
            if (auto defined = glsl::definition_of(scene, setting->first))
                hold(k_define, *setting, *std::move(defined));
    return held;
}

SceneRequest without_edited(SceneRequest request, const std::vector<HeldValue>& before,
                            const std::vector<HeldValue>& now) {
    for (const HeldValue& held : now)
        if (held.option == k_set && is_edited(held, before))
            std::erase_if(request.sets, [&](const std::string& text) { return names(text, held.name); });
    return request;
}

std::vector<std::string> edits_of_held(const std::vector<HeldValue>& before,
                                       const std::vector<HeldValue>& now) {
    std::vector<std::string> lines;
    for (const HeldValue& held : now)
        if (is_edited(held, before))
            lines.push_back(held.option == k_set
                                ? fmt::format("{} is now {}, from the file; {} {}={} no longer applies",
                                              held.name, held.in_file, held.option, held.name, held.value)
                                : fmt::format("{} stays {} because of {}; the file's definition is now {}",
                                              held.name, held.value, held.option, held.in_file));
    return lines;
}

std::vector<std::string> edits_of_turned(const std::vector<scene::Knob>& before,
                                         const std::vector<scene::Knob>& now,
                                         const std::vector<scene::KnobSetting>& turned) {
    std::vector<std::string> lines;
    for (const scene::Knob& knob : now) {
        const auto known = std::ranges::find(before, knob.name, &scene::Knob::name);
        const auto value = value_after(knob, turned);
        if (known != before.end() && known->initial != knob.initial && value != knob.initial &&
            std::ranges::find(turned, knob.name, &scene::KnobSetting::name) != turned.end())
            lines.push_back(fmt::format("{} stays {}, as you set it; the file's default is now {}", knob.name,
                                        to_string(knob, value), to_string(knob, knob.initial)));
    }
    return lines;
}

namespace {

/// Bytes of a line of texts; the texts of a scene are much smaller.
constexpr size_t k_longest_line = size_t{256} << 20;

/// Returns the texts of a line, null for each file that counts again; nothing if it has another form.
std::optional<std::map<fs::path, std::optional<std::string>>> texts_in(const Json& json) {
    if (!json.is_object() || !json.contains("texts") || !json["texts"].is_object())
        return std::nullopt;
    std::map<fs::path, std::optional<std::string>> texts;
    for (const auto& [file, text] : json["texts"].items()) {
        std::error_code error;
        const fs::path name = fs::weakly_canonical(file, error);
        if (error || !(text.is_string() || text.is_null()))
            return std::nullopt;
        texts[name] = text.is_string() ? std::optional(text.get<std::string>()) : std::nullopt;
    }
    return texts;
}

} // namespace

Result<std::shared_ptr<EditorTexts>> EditorTexts::open() {
    std::shared_ptr<EditorTexts> made(new EditorTexts);
    made->shared_ = ::memfd_create("texts", MFD_CLOEXEC);
    made->stop_ = ::eventfd(0, EFD_CLOEXEC);
    while (made->bytes_.find('\n') == std::string::npos)
        if (!made->read_block())
            return fail(ErrorCode::usage, "--editor: standard input ended before the first line of texts");
    if (!made->take_lines() || made->shared_ < 0 || made->stop_ < 0)
        return fail(ErrorCode::usage, "--editor: standard input needs lines such as "
                                      "{\"texts\": {\"/path/a.glsl\": \"…\"}}");
    (void)made->take();
    return made;
}

EditorTexts::~EditorTexts() {
    if (thread_.joinable()) {
        ::eventfd_write(stop_, 1);
        thread_.join();
    }
    for (const int fd : {shared_, stop_})
        if (fd >= 0)
            ::close(fd);
}

void EditorTexts::Waking::set(std::function<void()> wake) {
    if (!texts_)
        return;
    const std::lock_guard lock(texts_->mutex_);
    texts_->wake_ = std::move(wake);
    if (texts_->wake_ && !texts_->thread_.joinable())
        texts_->thread_ = std::thread([texts = texts_] { texts->run(); });
}

/// Returns false at the end of the input.
bool EditorTexts::read_block() {
    std::array<char, 1 << 16> block;
    ssize_t count;
    do
        count = ::read(STDIN_FILENO, block.data(), block.size());
    while (count < 0 && errno == EINTR);
    if (count <= 0 || bytes_.size() + size_t(count) > k_longest_line)
        return false;
    bytes_.append(block.data(), size_t(count));
    return true;
}

/// Takes the whole lines that have arrived; returns false if one has another form.
bool EditorTexts::take_lines() {
    const size_t end = bytes_.rfind('\n') + 1; // 0: none
    const std::string lines = bytes_.substr(0, end);
    bytes_.erase(0, end);
    for (const std::string_view line : text::lines_of(lines)) {
        if (line.empty())
            continue;
        const Json json = parse_or_discard(line);
        auto texts = texts_in(json);
        if (!texts)
            return false;
        const std::lock_guard lock(mutex_);
        if (json.contains("note") && json["note"].is_string()) {
            note_ = json["note"].get<std::string>();
            if (wake_)
                wake_();
        }
        for (auto& [file, text] : *texts) {
            changed_.push_back(file);
            if (text)
                texts_[file] = *std::move(text);
            else
                texts_.erase(file);
        }
    }
    return true;
}

void EditorTexts::run() {
    bool goes_on = true;
    while (goes_on) {
        std::array<pollfd, 2> waits{{{STDIN_FILENO, POLLIN, 0}, {stop_, POLLIN, 0}}};
        if (::poll(waits.data(), waits.size(), -1) < 0 && errno == EINTR)
            continue;
        if (waits[1].revents != 0)
            return;
        goes_on = read_block() && take_lines();
        const std::lock_guard lock(mutex_);
        ended_ = !goes_on;
        if (wake_ && (ended_ || !changed_.empty()))
            wake_();
    }
}

std::optional<EditorTexts::Change> EditorTexts::take() {
    const std::lock_guard lock(mutex_);
    if (changed_.empty())
        return std::nullopt;
    share();
    return Change{texts_, std::exchange(changed_, {})};
}

/// Writes the texts into the file in memory.
void EditorTexts::share() {
    Json json = Json::object();
    for (const auto& [file, text] : texts_)
        json[file.string()] = text;
    const std::string line = dump(Json{{"texts", std::move(json)}});
    if (::ftruncate(shared_, 0) == 0 && ::lseek(shared_, 0, SEEK_SET) == 0)
        (void)write_all(shared_, std::as_bytes(std::span(line)));
}

scene::UnsavedTexts EditorTexts::shared() const {
    constexpr int k_most_tries = 100;
    scene::UnsavedTexts texts;
    for (int i = 0; i < k_most_tries; ++i) {
        std::string line;
        std::array<char, 1 << 16> block;
        for (ssize_t count; (count = ::pread(shared_, block.data(), block.size(), off_t(line.size()))) > 0;)
            line.append(block.data(), size_t(count));
        const auto found = texts_in(parse_or_discard(line));
        if (!found) { // it is being written
            ::usleep(1000);
            continue;
        }
        for (const auto& [file, text] : *found)
            texts[file] = text.value_or("");
        break;
    }
    return texts;
}

std::string EditorTexts::note() const {
    const std::lock_guard lock(mutex_);
    return note_;
}

bool EditorTexts::ended() const {
    const std::lock_guard lock(mutex_);
    return ended_;
}

LiveScene::LiveScene(SceneRequest request, FileWatcher watcher, const std::function<void()>& wake)
    : request_(std::move(request)), watcher_(std::move(watcher)), builder_(wake) {
    scene::Scene named;
    named.file = request_.path;
    name_ = named.name();
    request_.knobs_may_go = true;
}

LiveScene::Loading LiveScene::load(const SceneRequest& request, const std::vector<HeldValue>& before) {
    const double begun = file_clock_seconds();
    Loading loading{load_as_written(request), {}, begun};
    if (!loading.scene)
        return loading;
    loading.held = held_values(request, *loading.scene);
    const SceneRequest asked = without_edited(request, before, loading.held);
    if (auto applied = apply_options(asked, *loading.scene); !applied)
        loading.scene = fail(std::move(applied.error()));
    return loading;
}

Result<LiveScene> LiveScene::create(SceneRequest request, Loading first, const View& view,
                                    const std::function<void()>& wake) {
    auto watcher = FileWatcher::create(wake);
    if (!watcher)
        return fail(std::move(watcher.error()));
    LiveScene live(std::move(request), *std::move(watcher), wake);
    if (auto begun = live.begin(live.watched(std::move(first)), view); !begun) {
        if (is_final(begun.error()))
            return fail(std::move(begun.error()));
        live.fail_with(std::move(begun.error()));
    }
    return live;
}

/// Returns the files whose change may affect the scene or fix it.
std::vector<fs::path> LiveScene::files_of(const Result<scene::Scene>& scene) const {
    std::vector<fs::path> files = scene ? scene->files : files_;
    files.push_back(request_.path);
    std::error_code ignored;
    if (fs::is_directory(request_.path, ignored))
        files.push_back(request_.path / "");
    if (scene)
        return files;
    // The missing or wrong file may be one that the last good scene did not have.
    files.insert(files.end(), in_folder_.begin(), in_folder_.end());
    files.insert(files.end(), scene.error().files.begin(), scene.error().files.end());
    for (const Diagnostic& diagnostic : scene.error().diagnostics)
        if (fs::exists(diagnostic.where.file, ignored))
            files.emplace_back(diagnostic.where.file);
    return files;
}

/// Watches the files of the loaded scene. Loads it again if a file was saved between loading and watching.
LiveScene::Loading LiveScene::watched(Loading loading) {
    constexpr int k_most_rounds = 4; // for files that change all the time
    for (int round = 0; round < k_most_rounds; ++round) {
        in_folder_ = scene::scene_files_in(request_.path);
        auto files = files_of(loading.scene);
        if (files == watched_)
            break;
        const auto seen = watcher_.watch(files);
        watched_ = std::move(files);
        if (!seen && loading.scene)
            say(to_string(seen.error())); // the scene can still be shown
        const auto is_new = [&](const fs::path& file) { return touched_since(file, loading.begun); };
        if (std::ranges::none_of(watched_, is_new))
            break;
        loading = load(request_, held_on_show_);
    }
    if (loading.scene) {
        files_ = loading.scene->files;
        name_ = loading.scene->name();
        request_.said = loading.scene->warnings;
    }
    return loading;
}

/// Returns the saved files. Ignores changes in a scene folder that add or remove no file of the scene, and
/// files whose text in an editor counts instead.
std::vector<FileWatcher::Change> LiveScene::changed() {
    auto changes = watcher_.changed();
    const auto is_folder = [&](const auto& change) { return change.file == request_.path / ""; };
    if (std::ranges::any_of(changes, is_folder) && scene::scene_files_in(request_.path) == in_folder_)
        std::erase_if(changes, is_folder);
    std::error_code ignored;
    std::erase_if(changes, [&](const auto& change) {
        return request_.files.unsaved.contains(fs::weakly_canonical(change.file, ignored));
    });
    return changes;
}

Result<void> LiveScene::begin(Loading loading, const View& view) {
    if (!loading.scene)
        return fail(std::move(loading.scene.error()));
    held_ = std::move(loading.held);
    return build(*std::move(loading.scene), view);
}

Result<void> LiveScene::build(scene::Scene scene, const View& view, Settle settle) {
    auto context = TRY(view.make_context());
    building_since_ = now_seconds();
    settling_ = settle == Settle::yes;
    builder_.start({std::move(context), std::move(scene), view.options, view.inputs, settling_,
                    view.rehearsal, HeldTexts{request_.sets, request_.defines}});
    return {};
}

void LiveScene::build_anew(const scene::Scene& scene, const View& view, Settle settle) {
    (void)build(scene, view, settle); // if it fails, the current Stage stays on show
}

std::optional<double> LiveScene::building_since() const {
    return builder_.building() && !settling_ ? std::optional(building_since_) : std::nullopt;
}

Result<std::optional<Stage>> LiveScene::follow(const View& view, double now) {
    if (const auto changes = changed(); !changes.empty()) {
        saved_ = true;
        typed_ = false;
        const auto last = std::ranges::max(changes, {}, &FileWatcher::Change::at).at;
        times_ = ReloadTimes{seconds_of(last), now};
        reload(view);
    }
    if (report_at_ && now >= *report_at_)
        report_failure();
    auto built = builder_.take();
    if (!built)
        return std::nullopt;
    if (settling_)
        return *built ? std::optional(**std::move(built)) : std::nullopt;
    if (!*built && !saved_ && is_final(built->error()))
        return fail(std::move(built->error()));
    if (!*built) {
        fail_with(std::move(built->error()));
        return std::nullopt;
    }
    mended();
    if (times_)
        times_->compiled = now_seconds();
    times_of_stage_ = std::exchange(times_, std::nullopt);
    return std::move(**built);
}

void LiveScene::reload(const View& view) {
    builder_.abandon();
    Loading loading = watched(load(request_, held_on_show_));
    times_->loaded = now_seconds();
    if (auto begun = begin(std::move(loading), view); !begun)
        fail_with(std::move(begun.error()));
}

void LiveScene::fail_with(Error error) {
    failure_ = std::move(error);
    report_at_ = now_seconds() + (typed_ ? 0 : k_half_written_seconds);
}

void LiveScene::report_failure() {
    report_at_.reset();
    say(*failure_);
    if (!shown_ && !std::exchange(waits_, true))
        say(fmt::format("waiting for {}: loads once the error is fixed and saved", request_.path.string()));
}

void LiveScene::mended() {
    if (failure_ && !report_at_)
        say(fmt::format("{}: compiles{}", request_.path.string(), shown_ ? " again" : ""));
    failure_.reset();
    report_at_.reset();
    for (const std::string& line : edits_of_held(held_on_show_, held_))
        say(line);
    request_ = without_edited(std::move(request_), held_on_show_, held_);
    held_on_show_ = held_;
    shown_ = true;
}

void LiveScene::stop_settling() {
    if (settling_)
        builder_.abandon();
}

void LiveScene::define(const std::string& name, const std::optional<std::string>& value, const View& view) {
    std::vector<std::string> defines = request_.defines;
    std::erase_if(defines, [&](const std::string& text) {
        const auto split = scene::split_setting(text, "--define");
        return split && split->first == name;
    });
    if (value)
        defines.push_back(fmt::format("{}={}", name, *value));
    hold(std::move(defines), view);
}

void LiveScene::give_channel(int channel, const std::string& what, const View& view) {
    const std::string begin = fmt::format("{}=", channel);
    std::erase_if(request_.channels, [&](const std::string& text) { return text.starts_with(begin); });
    request_.channels.push_back(begin + what);
    hold(request_.defines, view);
}

void LiveScene::hold(std::vector<std::string> defines, const View& view) {
    request_.defines = std::move(defines);
    saved_ = true;
    const double now = now_seconds();
    times_ = ReloadTimes{now, now};
    reload(view);
}

void LiveScene::put(EditorTexts::Change change, const View& view) {
    request_.files.unsaved = std::move(change.texts);
    std::error_code ignored;
    const auto is_read = [&](const fs::path& file) {
        return std::ranges::any_of(
            watched_, [&](const fs::path& each) { return fs::weakly_canonical(each, ignored) == file; });
    };
    if (std::ranges::none_of(change.files, is_read))
        return;
    saved_ = typed_ = true;
    const double now = now_seconds();
    times_ = ReloadTimes{now, now};
    reload(view);
}

void LiveScene::give_up() {
    builder_.abandon();
    times_.reset();
}

} // namespace tidemark::window
