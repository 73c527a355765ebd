// `tidemark lsp`: the language server on standard input and output. One thread, which waits for the editor
// and for the compiling process (cli/lsp/compile_check.hpp).
#include "base/doing.hpp"
#include "base/try.hpp"
#include "cli/command_line.hpp"
#include "cli/commands.hpp"
#include "cli/console.hpp"
#include "cli/limits.hpp"
#include "cli/lsp/compile_check.hpp"
#include "cli/options.hpp"
#include "cli/version.hpp"
#include "lsp/session.hpp"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <memory>

namespace tidemark::cli {
namespace {

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
    Server(LspOptions options, ForkedLimits limits)
        : options_(std::move(options)), limits_(std::move(limits)) {}

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
            return fail(ErrorCode::usage,
                        "what comes in is no language server protocol: a message begins with "
                        "a header `Content-Length: N` and an empty line");
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
    ForkedLimits limits_;
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
    Command command =
        app.add_subcommand("lsp", "A language server for editors, on standard input and output");
    add_device_options(command, options->device);
    add_memory_option(command, options->limits);
    command.add_option("--timeout", options->timeout, "Give up a scene that takes longer to compile")
        .type_name("SECONDS")
        .check(number<double>("a number of seconds from 0.1", 0.1))
        .capture_default_str();
    command.on_call([options, &chosen] { chosen = [options] { return serve(*options); }; });
}

} // namespace tidemark::cli
