// `tidemark lsp`: the language server on standard input and output. One thread, which waits for the editor
// and for the compiling process.

#include "base/encoding.hpp"
#include "base/error.hpp"
#include "base/supervision.hpp"
#include "cli/check.hpp"
#include "cli/commands.hpp"
#include "cli/previews.hpp"
#include "editor/session.hpp"
#include "host/command_line.hpp"
#include "host/console.hpp"
#include "host/devices.hpp"
#include "host/forked.hpp"
#include "host/gl_context.hpp"
#include "host/json.hpp"
#include "host/requests.hpp"
#include "host/scene_report.hpp"
#include "host/supervision.hpp"
#include "lab/fix.hpp"
#include "lab/instrumented_pass.hpp"
#include "lab/text_findings.hpp"
#include "render/compiled_scene.hpp"
#include "scene/load_scene.hpp"
#include "scene/scene.hpp"
#include "shader/portability.hpp"
#include "shader/shader_source.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace tidemark::cli {

using namespace host;
using host::resolve;
using host::to_json;
namespace fs = std::filesystem;
namespace {

bool is_error(const Diagnostic& diagnostic) {
    return diagnostic.severity == Severity::error;
}

using Diagnostics = std::vector<Diagnostic>;

/// Adds diagnostics that are not in the list yet: Common is compiled with every pass, so its errors repeat.
void add(Diagnostics& all, Diagnostics more) {
    for (Diagnostic& each : more)
        if (std::ranges::find(all, each) == all.end())
            all.push_back(std::move(each));
}

Diagnostics diagnostics_of(const Error& error) {
    if (!error.diagnostics.empty())
        return error.diagnostics;
    return {{{}, Severity::error, error.message}};
}

/// The problems of one scene that compilers accept: uninitialised values, derivatives in non-uniform control
/// flow, miscounting float loops, and code that ShaderToy's own site does not compile. The scene must outlive
/// it. A context must be current.
class Hints {
public:
    explicit Hints(const scene::Scene& scene) : scene_(scene) {}

    /// Adds the hints of a pass that was linked in that dialect.
    void read(const scene::Pass& pass, const glsl::Dialect& dialect) {
        const auto text = lab::read_text(scene_, pass, dialect, true);
        if (!text)
            return; // the driver accepts some texts that the analysis cannot follow
        const glsl::TreeFacts facts = glsl::find_facts(**text);
        for (const glsl::Unassigned& each : glsl::find_unassigned(**text, facts))
            add((*text)->spelled(lab::word_without_value(**text, each)),
                fmt::format(
                    "{} has no value{}: it reads as 0 on ShaderToy's site and here, as any value elsewhere",
                    (*text)->word_of(each.what), lab::words_for(each.why)));
        for (const glsl::Divergent& each : glsl::find_divergent(**text, facts, lab::which_have_mipmaps(pass)))
            if (!each.harmless)
                add((*text)->spelled((*text)->tree()[each.call].begin), lab::words_for(**text, each));
        for (const glsl::FloatCounter& each : glsl::miscounting_loops(**text, facts))
            add((*text)->spelled((*text)->tree()[each.loop].begin), lab::words_for(each));
    }

    /// Returns all hints, except on lines with a problem. `compile`: also compiles for ShaderToy's site,
    /// unless there are errors.
    std::vector<Diagnostic> take(const std::vector<Diagnostic>& problems, bool compile) {
        std::vector<Diagnostic> unportable = glsl::portability_lint(scene_);
        if (compile && std::ranges::none_of(problems, is_error))
            add_site_refusals(scene_, unportable);
        for (Diagnostic& each : unportable)
            add(std::move(each.where), "not portable to ShaderToy's site: " + each.message);
        std::erase_if(found_, [&](const Diagnostic& hint) {
            return std::ranges::any_of(problems, [&](const Diagnostic& problem) {
                return problem.where.file == hint.where.file && problem.where.line == hint.where.line;
            });
        });
        return std::move(found_);
    }

private:
    /// Adds a hint once. Ignores lines without a file: those are generated.
    void add(SourceLocation where, std::string message) {
        Diagnostic hint{std::move(where), Severity::note, std::move(message)};
        if (!hint.where.file.empty() && std::ranges::find(found_, hint) == found_.end())
            found_.push_back(std::move(hint));
    }

    const scene::Scene& scene_;
    std::vector<Diagnostic> found_;
};

/// Formats a line for the parent: the diagnostics in the JSON form of an Error.
std::string line_of(std::string_view kind, const Diagnostics& diagnostics) {
    return dump(
        Json{{"kind", kind}, {"found", host::to_json(Error{.message = {}, .diagnostics = diagnostics})}});
}

/// Runs in the child process. Compiles every pass, even after one that fails, and even if no other pass reads
/// it; removes uncalled functions first, as capture does. Errors in uncalled functions are hints instead,
/// because ShaderToy's site compiles them.
Result<void> examine(const fs::path& path, const scene::UnsavedTexts& texts, const host::DeviceChoice& device,
                     const Tell& tell) {
    const scene::Scene scene = TRY(scene::load_scene(path, {.media = {}, .unsaved = texts}));
    Diagnostics problems = scene.warnings;
    const auto context = host::HeadlessContext::create(device);
    if (!context)
        add(problems, {{{}, Severity::warning, "could not compile: " + to_string(context.error())}});
    Hints hints(scene);
    for (const scene::Pass& pass : scene.passes) {
        if (!context)
            continue;
        const auto linked = render::link_pass(scene, pass, {.specialise = glsl::Specialise::unreachable});
        if (linked)
            hints.read(pass, linked->dialect);
        else
            add(problems, diagnostics_of(linked.error()));
    }
    tell(line_of("problems", problems));
    tell(line_of("hints", hints.take(problems, context.has_value())));
    return {};
}

Diagnostics left_by(const ForkedResult& result, const Limits& limits) {
    if (!result.crash.empty())
        return {{{}, Severity::error, result.crash}};
    const std::string what = result.doing.empty() ? "the scene" : result.doing;
    if (result.timed_out)
        return {{{}, Severity::error, fmt::format("{} takes more than {:.3g} s", what, *limits.seconds)}};
    return {{{}, Severity::error, fmt::format("{} takes too much memory (--memory)", what)}};
}

/// Compiles a scene with the driver in a separate process and reports diagnostics. A driver that crashes or
/// hangs, or a scene that exhausts memory, becomes a diagnostic, too.
class CompileCheck {
public:
    /// Starts the check with the texts that the editor holds. Call it while the process has no threads and no
    /// context (host/forked.hpp).
    static Result<CompileCheck> start(const fs::path& scene, const lsp::Documents& documents,
                                      const host::DeviceChoice& device, const Limits& limits) {
        auto helper = TRY(ForkedHelper::start([&](const std::string&, const Tell& tell) {
            host::do_without_full_driver_cache();
            if (const auto done = examine(scene, documents.texts(), device, tell); !done)
                tell(line_of("problems", diagnostics_of(done.error())));
        }));
        helper.begin({}, limits);
        return CompileCheck(scene, std::move(helper), limits);
    }

    const std::filesystem::path& scene() const { return scene_; }
    int descriptor() const { return helper_.descriptor(); }

    /// Returns the verdicts that have arrived since the last call, each an extension of the one before. Never
    /// waits.
    std::vector<lsp::Verdict> look() {
        std::vector<lsp::Verdict> verdicts;
        const auto hear = [&](std::string_view line) {
            const Json json = parse_json(line);
            Diagnostics found = error_of(json.at("found"))->diagnostics;
            const bool problems = json.at("kind") == "problems";
            answered_ |= problems;
            (problems ? found_.problems : found_.hints) = std::move(found);
            verdicts.push_back(found_);
        };
        const auto result = helper_.look(hear, std::chrono::milliseconds(0));
        ended_ = result.has_value();
        if (ended_ && !answered_) {
            found_.problems = left_by(*result, limits_);
            verdicts.push_back(found_);
        }
        return verdicts;
    }

    bool ended() const { return ended_; }

private:
    CompileCheck(std::filesystem::path scene, ForkedHelper helper, Limits limits)
        : scene_(std::move(scene)), helper_(std::move(helper)), limits_(std::move(limits)) {}

    std::filesystem::path scene_;
    ForkedHelper helper_;
    Limits limits_;
    lsp::Verdict found_{};
    bool answered_ = false; ///< the problems have arrived
    bool ended_ = false;
};

/// Returns the line for a scene whose error was not measured.
std::string unmeasured_line(const std::string& why) {
    return dump(Json{{"why", why}});
}

/// Runs in a child process of low priority, which does not slow the previews down. Sends the error of the
/// picture in float, or why there is none, then the fixes.
Result<void> measure_scene(const fs::path& path, const scene::UnsavedTexts& texts,
                           const host::DeviceChoice& device, const Tell& tell) {
    constexpr int k_low_priority = 10;
    [[maybe_unused]] const int priority = ::nice(k_low_priority);
    FixOptions options{.scene = {.path = path}, .device = device};
    options.scene.files.unsaved = texts;
    const scene::Scene scene = TRY(scene::load_scene(path, options.scene.files));
    const lab::Promises promises = TRY(promises_of(options.scene, scene));
    const auto context = TRY(host::HeadlessContext::create(device));
    const auto measured = [&](const Result<lab::ShownError>& error) {
        tell(error ? dump(Json{{"rmse", error->rmse}, {"worst", error->worst}, {"pixels", error->pixels}})
                   : unmeasured_line(error.error().message));
    };
    (void)send_fixes(options, scene, promises, tell, measured); // its errors are the compile check's
    return {};
}

/// Measures a scene in the background: a separate process that may be ended at any time.
class Measuring {
public:
    /// Starts the measurement of the texts that the editor holds, while the process has no threads and no
    /// context, like CompileCheck::start.
    static Result<Measuring> start(const fs::path& scene, const lsp::Documents& documents,
                                   const host::DeviceChoice& device, const Limits& limits) {
        auto helper = TRY(ForkedHelper::start([&](const std::string&, const Tell& tell) {
            host::do_without_full_driver_cache();
            if (const auto done = measure_scene(scene, documents.texts(), device, tell); !done)
                tell(unmeasured_line(done.error().message));
        }));
        helper.begin({}, limits);
        return Measuring(scene, std::move(helper), limits);
    }

    const fs::path& scene() const { return scene_; }
    int descriptor() const { return helper_.descriptor(); }
    bool ended() const { return ended_; }

    /// Passes on the lines that have arrived since the last call. Never waits.
    void look(const Tell& hear) {
        const auto note = [&](std::string_view line) {
            heard_ = true;
            hear(line);
        };
        const auto result = helper_.look(note, std::chrono::milliseconds(0));
        ended_ = result.has_value();
        if (ended_ && !heard_)
            hear(unmeasured_line(left_by(*result, limits_).front().message));
    }

private:
    Measuring(fs::path scene, ForkedHelper helper, Limits limits)
        : scene_(std::move(scene)), helper_(std::move(helper)), limits_(std::move(limits)) {}

    fs::path scene_;
    ForkedHelper helper_;
    Limits limits_;
    bool heard_ = false; ///< a line has arrived
    bool ended_ = false;
};

/// Returns the fix of an offer's line; its report is without the place that it begins with.
lsp::MeasuredFix fix_of(const Json& line) {
    lsp::MeasuredFix fix{line.at("offer").at("cure").get<std::string>(),
                         std::string(trimmed(line.at("text").get<std::string>())),
                         {}};
    for (ChangedFile& file : files_of_offer(line)) {
        if (fix.report.starts_with(file.file + ":"))
            fix.report.erase(0, fix.report.find(": ", file.file.size()) + 2);
        fix.files.push_back({file.file, std::move(file.before), std::move(file.after)});
    }
    return fix;
}

/// Returns the error in the words of a preview's title, in steps of 1/255.
std::string error_words(const Json& error) {
    const auto steps = [&](const char* name) {
        const double value = 255 * error.at(name).get<double>();
        return value > 0 && value < 0.01 ? "<0.01" : fmt::format("{:.2g}", value);
    };
    return fmt::format("error {} of 255, worst {}", steps("rmse"), steps("worst"));
}

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// Pause after an edit before a check starts. Keystrokes come closer than this, so texts in between are not
/// compiled.
constexpr milliseconds k_quiet{100};
/// Pause after an edit before the previews get it.
constexpr milliseconds k_quiet_preview{50};
/// Pause after the last change before a scene is measured in the background.
constexpr milliseconds k_rest{2000};
/// Interval at which the compiling process's time and memory are checked.
constexpr milliseconds k_look{50};

struct LspOptions {
    host::DeviceChoice device{};
    LimitOptions limits;
    double timeout = 30;
    double measure = 30; ///< seconds; 0: does not measure
};

class Server {
public:
    Server(LspOptions options, Limits limits)
        : options_(std::move(options)), limits_(std::move(limits)),
          previews_(options_.limits.memory ? std::vector<std::string>{"--memory", *options_.limits.memory}
                                           : std::vector<std::string>{}) {}

    Result<int> run() {
        while (!session_.exit_code()) {
            std::vector<pollfd> inputs{{STDIN_FILENO, POLLIN, 0},
                                       {check_ ? check_->descriptor() : -1, POLLIN, 0},
                                       {measuring_ ? measuring_->descriptor() : -1, POLLIN, 0}};
            previews_.add_to(inputs);
            ::poll(inputs.data(), inputs.size(), int(patience().count()));
            if (inputs[0].revents != 0 && !TRY(read()))
                return 1; // an editor sends `exit` before it closes the stream
            TRY(hear());
            TRY(compile());
            TRY(measure_rested());
            TRY(preview());
        }
        return *session_.exit_code();
    }

private:
    milliseconds patience() const {
        const auto now = Clock::now();
        auto until = Clock::time_point::max();
        if (check_ || measuring_ || previews_.waits())
            until = now + k_look;
        if (may_measure())
            until = std::min(until, rested_at_);
        if (!check_ && !session_.stale().empty())
            until = std::min(until, quiet_at_);
        if (send_at_)
            until = std::min(until, *send_at_);
        if (until == Clock::time_point::max())
            return milliseconds(-1); // until the editor sends a message
        return std::max(std::chrono::ceil<milliseconds>(until - now), milliseconds(0));
    }

    /// Returns false at the end of the stream. Fails where the stream is not the language server protocol.
    Result<bool> read() {
        std::array<char, 1 << 16> block;
        const ssize_t count = ::read(STDIN_FILENO, block.data(), block.size());
        if (count < 0 && errno == EINTR)
            return true;
        if (count <= 0)
            return false;
        reader_.feed({block.data(), size_t(count)});
        while (const auto message = reader_.next())
            TRY(receive(*message));
        if (reader_.broken())
            return fail(ErrorCode::usage, "the input is not the language server protocol: a message begins "
                                          "with a header `Content-Length: N` and an empty line");
        return true;
    }

    Result<void> receive(const std::string& message) {
        const int edits = session_.edits(), revisions = session_.revisions();
        TRY(put_exact(session_.receive(message)));
        if (session_.edits() != edits)
            quiet_at_ = Clock::now() + k_quiet;
        if (session_.revisions() != revisions) {
            send_at_ = Clock::now() + k_quiet_preview;
            rested_at_ = Clock::now() + k_rest;
        }
        for (const lsp::Order& order : session_.take_orders())
            TRY(put_exact(previews_.obey(order, session_.documents().texts())));
        return {};
    }

    /// Sends texts to the previews, and passes on what they print.
    Result<void> preview() {
        if (send_at_ && Clock::now() >= *send_at_) {
            send_at_.reset();
            previews_.send(session_.documents().texts());
        }
        return put_exact(previews_.look());
    }

    /// Starts a check, or restarts one whose texts are out of date.
    Result<void> compile() {
        if (session_.stale().empty() || Clock::now() < quiet_at_)
            return {};
        if (check_ && !session_.stale().contains(check_->scene()))
            return {}; // one check at a time
        const std::filesystem::path scene = check_ ? check_->scene() : *session_.stale().begin();
        check_.reset();
        session_.begin(scene);
        check_.emplace(TRY(CompileCheck::start(scene, session_.documents(), options_.device, limits_)));
        return {};
    }

    bool may_measure() const {
        return options_.measure > 0 && !measuring_ && !check_ && session_.stale().empty() &&
               session_.unmeasured();
    }

    /// Ends a measurement whose texts have changed, passes on what one has found, and starts one after a
    /// rest.
    Result<void> measure_rested() {
        if (measuring_ && !session_.is_measured(measuring_->scene()))
            measuring_.reset();
        std::erase_if(noted_, [&](const fs::path& scene) {
            if (session_.is_measured(scene))
                return false;
            previews_.note(scene, "");
            return true;
        });
        if (measuring_) {
            std::string told;
            measuring_->look([&](std::string_view line) {
                const Json json = parse_json(line);
                if (json.contains("offer"))
                    told += session_.show_fix(measuring_->scene(), fix_of(json));
                else if (!json.contains("remains"))
                    told += session_.show_error(measuring_->scene(), lsp::Json(json));
                if (json.contains("rmse")) {
                    previews_.note(measuring_->scene(), error_words(json));
                    noted_.insert(measuring_->scene());
                }
            });
            TRY(put_exact(told));
            if (measuring_->ended())
                measuring_.reset();
        }
        if (!may_measure() || Clock::now() < rested_at_)
            return {};
        const fs::path scene = *session_.unmeasured();
        session_.begin_measuring(scene);
        measuring_.emplace(TRY(Measuring::start(scene, session_.documents(), options_.device,
                                                {.seconds = options_.measure, .memory = limits_.memory})));
        return {};
    }

    Result<void> hear() {
        if (!check_)
            return {};
        const auto verdicts = check_->look();
        if (!session_.stale().contains(check_->scene())) // else the result is about an outdated text
            for (const lsp::Verdict& verdict : verdicts)
                TRY(put_exact(session_.conclude(check_->scene(), verdict)));
        if (check_->ended())
            check_.reset();
        return {};
    }

    LspOptions options_;
    Limits limits_;
    lsp::Session session_{k_version};
    lsp::MessageReader reader_;
    std::optional<CompileCheck> check_;
    std::optional<Measuring> measuring_;
    std::set<fs::path> noted_; ///< scenes whose previews show an error
    Clock::time_point quiet_at_{};
    Clock::time_point rested_at_{};
    std::optional<Clock::time_point> send_at_; ///< when the previews get the newest texts
    Previews previews_;
};

Result<int> serve(const LspOptions& options) {
    const Limits limits = TRY(resolve(options.limits));
    Doing::note_on(DoingPage::make()); // records the driver call of the compiling process
    return Server(options, {.seconds = options.timeout, .memory = limits.memory}).run();
}

} // namespace

void add_lsp(Command app, Action& chosen) {
    auto options = std::make_shared<LspOptions>();
    Command command = app.add_subcommand("lsp", "Language server for editors, on standard input and output");
    add_device_options(command, options->device);
    add_memory_option(command, options->limits);
    command.add_option("--timeout", options->timeout, "Stops compiling a scene that takes longer")
        .type_name("SECONDS")
        .check(number<double>("a number of seconds from 0.1", 0.1))
        .capture_default_str();
    command
        .add_option("--measure", options->measure,
                    "Seconds that a scene that rests is measured in the background; 0: not at all")
        .type_name("SECONDS")
        .check(number<double>("a number of seconds from 0", 0.0))
        .capture_default_str();
    command.add_flag(
        "--stdio", [] {}, "Uses standard input and output, as it does without this option");
    command
        .add_option(
            "--clientProcessId", [](const std::string&) {}, "Ignored; some editors give it")
        .group("");
    command.on_call([options, &chosen] { chosen = [options] { return serve(*options); }; });
}

} // namespace tidemark::cli
