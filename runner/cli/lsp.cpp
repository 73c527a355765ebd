// `tidemark lsp`: the language server on standard input and output. One thread, which waits for the editor
// and for the compiling process.

#include "base/error.hpp"
#include "base/supervision.hpp"
#include "cli/commands.hpp"
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
#include "host/version.hpp"
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
#include <string>
#include <utility>
#include <vector>

namespace tidemark::cli {
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
    return dump(Json{{"kind", kind}, {"found", to_json(Error{.message = {}, .diagnostics = diagnostics})}});
}

/// Runs in the child process. Compiles every pass, even after one that fails, and even if no other pass reads
/// it; removes uncalled functions first, as capture does. Errors in uncalled functions are hints instead,
/// because ShaderToy's site compiles them.
Result<void> examine(const fs::path& path, const scene::UnsavedTexts& texts,
                     const platform::DeviceChoice& device, const Tell& tell) {
    const scene::Scene scene = TRY(scene::load_scene(path, {.media = {}, .unsaved = texts}));
    Diagnostics problems = scene.warnings;
    const auto context = platform::HeadlessContext::create(device);
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
                                      const platform::DeviceChoice& device, const Limits& limits) {
        auto helper = TRY(ForkedHelper::start([&](const std::string&, const Tell& tell) {
            platform::do_without_full_driver_cache();
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

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

/// Pause after an edit before a check starts. Keystrokes come closer than this, so texts in between are not
/// compiled.
constexpr milliseconds k_quiet{100};
/// Interval at which the compiling process's time and memory are checked.
constexpr milliseconds k_look{50};

struct LspOptions {
    platform::DeviceChoice device{};
    LimitOptions limits;
    double timeout = 30;
};

class Server {
public:
    Server(LspOptions options, Limits limits) : options_(std::move(options)), limits_(std::move(limits)) {}

    Result<int> run() {
        while (!session_.exit_code()) {
            std::array<pollfd, 2> inputs{
                {{STDIN_FILENO, POLLIN, 0}, {check_ ? check_->descriptor() : -1, POLLIN, 0}}};
            ::poll(inputs.data(), inputs.size(), int(patience().count()));
            if (inputs[0].revents != 0 && !TRY(read()))
                return 1; // an editor sends `exit` before it closes the stream
            TRY(hear());
            TRY(compile());
        }
        return *session_.exit_code();
    }

private:
    milliseconds patience() const {
        if (check_)
            return k_look;
        if (session_.stale().empty())
            return milliseconds(-1); // until the editor sends a message
        const auto left = std::chrono::ceil<milliseconds>(quiet_at_ - Clock::now());
        return std::max(left, milliseconds(0));
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
        const int edits = session_.edits();
        TRY(put_exact(session_.receive(message)));
        if (session_.edits() != edits)
            quiet_at_ = Clock::now() + k_quiet;
        return {};
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
    Clock::time_point quiet_at_{};
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
    command.on_call([options, &chosen] { chosen = [options] { return serve(*options); }; });
}

} // namespace tidemark::cli
