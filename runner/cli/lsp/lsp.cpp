// `tidemark lsp`: the language server over standard input and output. One thread, which waits for the editor
// and for the process that compiles (cli/lsp/compile_check.hpp).
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

/// Keys of a person who types come closer than this: a text in between is not worth a compiler.
constexpr milliseconds k_quiet{100};
/// Between two looks at what the compiler takes.
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
                return 1; // an editor says `exit` before it goes
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
            return milliseconds(-1); // until the editor wants something
        const auto left = std::chrono::ceil<milliseconds>(quiet_at_ - Clock::now());
        return std::max(left, milliseconds(0));
    }

    /// False at the end of the stream, and where no message can be found in it any more.
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

    /// Starts one, or one anew whose texts are old: the newest text wins.
    Result<void> compile() {
        if (session_.stale().empty() || Clock::now() < quiet_at_)
            return {};
        if (check_ && !session_.stale().contains(check_->scene()))
            return {}; // one after the other
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
        if (!session_.stale().contains(check_->scene())) // else it is about a text that is gone
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
    Doing::note_on(DoingPage::make()); // what the compiling process is at
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
