#include "window/stage.hpp"

#include "base/error.hpp"
#include "base/supervision.hpp"
#include "host/forked.hpp"
#include "host/program_trial.hpp"
#include "host/supervision.hpp"
#include "shader/driver_log.hpp"
#include "window/screen.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <limits>
#include <string_view>
#include <system_error>
#include <utility>

namespace tidemark::window {

using namespace host;
namespace {

constexpr auto k_settled = glsl::Specialise::invariant_uniforms;

/// Idle time before background optimisation: a user who edits a scene saves and drags more often.
constexpr double k_shortest_rest_seconds = 2;
/// Idle time for each second of compiling. A trial compiles the scene twice, which is then a tenth of the
/// idle time.
constexpr double k_rest_per_second_of_compiling = 20;

/// A frame of a Renderer, drawn in parts.
class RenderedParts : public FrameParts {
public:
    RenderedParts(render::Renderer& renderer, const render::FrameInputs& inputs, render::PartSize& size)
        : renderer_(renderer), frame_(renderer, inputs, size, now_seconds) {}

    Result<bool> draw_for(double seconds) override {
        const size_t before = renderer_.passes_drawn();
        auto whole = frame_.draw_for(seconds);
        drew_pass_ = renderer_.passes_drawn() != before;
        return whole;
    }
    bool drew_pass() const override { return drew_pass_; }
    double share() const override { return frame_.share(); }
    const std::vector<render::FrameInParts::PassSeconds>& seconds() const override {
        return frame_.seconds();
    }
    std::optional<DriverWork> work() const override {
        const auto& at = frame_.under_way();
        if (!at)
            return std::nullopt;
        return DriverWork{at->part, at->begun, [&at](double seconds) { return at->end.wait(seconds); }};
    }
    std::optional<DriverWork> cancel() override {
        auto at = render::FrameInParts::give_up(std::move(frame_));
        if (!at)
            return std::nullopt;
        const auto kept = std::make_shared<render::FrameInParts::UnderWay>(*std::move(at));
        return DriverWork{kept->part, kept->begun,
                          [kept](double seconds) { return kept->end.wait(seconds); }};
    }

private:
    render::Renderer& renderer_;
    render::FrameInParts frame_;
    bool drew_pass_ = false; ///< by the last call of draw_for
};

/// Concurrent builds. Each keeps a core busy, and drawing needs one, too.
constexpr size_t k_most_at_once = 3;

Result<Stage> build(StageBuilder::Order order, const std::function<bool()>& unwanted) {
    if (order.rehearsal && !order.settle && !glsl::is_modest(order.scene, order.options.precision))
        TRY(order.rehearsal->try_out(order.held, unwanted));
    if (unwanted()) // a cancelled try was not completed, so the scene must not reach the driver here
        return fail(ErrorCode::load, "the scene is no longer wanted");
    if (order.settle && !compiles_on_threads())
        return fail(ErrorCode::check_failed, "a trial would block the window");
    if (order.settle)
        return Stage::settle(std::move(order.context), order.scene, order.options, order.first);
    return Stage::create(std::move(order.context), std::move(order.scene), order.options, order.first);
}

/// Turns exceptions into errors, so that the picture on show stays.
Result<Stage> build_or_say_why(StageBuilder::Order order, const std::function<bool()>& unwanted) {
    try {
        return build(std::move(order), unwanted);
    } catch (const std::exception& error) {
        return fail(ErrorCode::load, fmt::format("the scene cannot be built: {}", error.what()));
    }
}

} // namespace

bool compiles_on_threads() {
    const char* const wish = std::getenv("TIDEMARK_ASYNC_COMPILE");
    return !wish || std::string_view(wish) != "off";
}

Result<Stage> Stage::create(host::SharedContext context, scene::Scene scene,
                            const render::RenderOptions& options, const render::FrameInputs& first) {
    TRY(context.make_current());
    const double start = now_seconds();
    auto renderer = TRY(render::Renderer::create(std::move(scene), options));
    renderer.warm_up(first);
    const double compiling = now_seconds() - start;
    const bool worth_settling = worth_trying(renderer, k_settled);
    context.leave();
    Stage stage(std::move(context), std::make_unique<render::Renderer>(std::move(renderer)));
    if (worth_settling)
        stage.seconds_to_settle_ =
            std::max(k_shortest_rest_seconds, k_rest_per_second_of_compiling * compiling);
    return stage;
}

Result<Stage> Stage::settle(host::SharedContext context, const scene::Scene& scene,
                            const render::RenderOptions& options, const render::FrameInputs& shown) {
    TRY(context.make_current());
    render::RenderOptions settled = options;
    settled.specialise = k_settled;
    TrialPlan plan{shown, shown, std::numeric_limits<size_t>::max()};
    plan.first.frame = 0; // buffers begin at frame 0
    plan.first.time = 0;
    plan.first.date = render::later(shown.date, -shown.time);
    plan.in_window = true;
    auto trial = TRY(choose_program(scene, settled, plan));
    if (!trial.share)
        return fail(ErrorCode::check_failed, "the optimised program is not faster");
    context.leave();
    Stage stage(std::move(context), std::make_unique<render::Renderer>(std::move(trial.renderer)));
    stage.share_ = trial.share;
    return stage;
}

bool Stage::draw(const render::FrameInputs& inputs, std::vector<render::PassTimer>* timers) {
    const size_t before = renderer_->passes_drawn();
    renderer_->draw(inputs, timers);
    return renderer_->passes_drawn() != before;
}

std::unique_ptr<FrameParts> Stage::begin(const render::FrameInputs& inputs, render::PartSize& size) {
    return std::make_unique<RenderedParts>(*renderer_, inputs, size);
}

Stage::~Stage() {
    if (!renderer_)
        return;
    const host::KeepCurrent current;
    (void)context_.make_current(); // GL objects must be deleted in the context that owns them
    renderer_.reset();
}

struct StageBuilder::Job {
    std::mutex mutex;
    bool abandoned = false;
    bool done = false;
    std::optional<Result<Stage>> outcome;
};

StageBuilder::~StageBuilder() {
    abandon();
    for (auto& [thread, job] : running_)
        thread.join();
}

void StageBuilder::start(Order order) {
    abandon();
    sweep();
    if (running_.size() < k_most_at_once)
        launch(std::move(order));
    else
        waiting_.emplace(std::move(order));
}

void StageBuilder::launch(Order order) {
    newest_ = std::make_shared<Job>();
    auto work = [job = newest_, wake = wake_, order = std::move(order)]() mutable {
        {
            auto built = build_or_say_why(std::move(order), [&job] {
                const std::lock_guard lock(job->mutex);
                return job->abandoned;
            });
            const std::lock_guard lock(job->mutex);
            if (!job->abandoned)
                job->outcome.emplace(std::move(built));
        } // destroys an abandoned Stage, before `done` is set
        const std::lock_guard lock(job->mutex);
        job->done = true;
        wake();
    };
    if (!compiles_on_threads()) {
        const host::KeepCurrent current;
        return work();
    }
    try {
        std::thread thread(std::move(work));
        running_.emplace_back(std::move(thread), newest_);
    } catch (const std::system_error& no_thread) {
        newest_->outcome.emplace(
            fail(ErrorCode::load, fmt::format("cannot start a thread to compile on: {}", no_thread.what())));
        wake_();
    }
}

void StageBuilder::abandon() {
    waiting_.reset();
    const auto job = std::exchange(newest_, nullptr); // outlives the lock of its own mutex
    if (!job)
        return;
    const std::lock_guard lock(job->mutex);
    job->abandoned = true;
    job->outcome.reset();
}

std::optional<Result<Stage>> StageBuilder::take() {
    sweep();
    if (waiting_ && running_.size() < k_most_at_once) {
        launch(*std::move(waiting_));
        waiting_.reset();
    }
    if (!newest_)
        return std::nullopt;
    std::optional<Result<Stage>> outcome;
    {
        const std::lock_guard lock(newest_->mutex);
        if (!newest_->outcome)
            return std::nullopt;
        outcome.emplace(*std::move(newest_->outcome));
        newest_->outcome.reset();
    }
    newest_ = nullptr;
    return outcome;
}

/// Removes threads that have finished.
void StageBuilder::sweep() {
    std::erase_if(running_, [](auto& running) {
        {
            const std::lock_guard lock(running.second->mutex);
            if (!running.second->done)
                return false;
        }
        running.first.join();
        return true;
    });
}

bool StageBuilder::busy() const {
    return std::any_of(running_.begin(), running_.end(), [](const auto& running) {
        const std::lock_guard lock(running.second->mutex);
        return !running.second->done;
    });
}

namespace {

constexpr int k_look_ms = 50;
/// Bytes of a message, which is one request or one answer.
constexpr size_t k_longest_message = 1 << 16;
/// First byte of a request (k_try), the message that cancels it (k_enough), and the answer for success
/// (k_well).
constexpr char k_try = '?', k_enough = '!', k_well = '\n';
/// Marks of the values in a request: each value is a mark, `NAME=VALUE` and a zero byte.
constexpr char k_set_mark = 's', k_define_mark = 'd';

std::string question(const HeldTexts& held) {
    std::string text(1, k_try);
    for (const auto& [mark, texts] :
         {std::pair(k_set_mark, &held.sets), std::pair(k_define_mark, &held.defines)})
        for (const std::string& each : *texts)
            text.append(1, mark).append(each).append(1, '\0');
    return text;
}

HeldTexts held_in(std::string_view question) {
    HeldTexts held;
    for (question.remove_prefix(1); !question.empty();) {
        const size_t end = std::min(question.find('\0'), question.size() - 1);
        auto& texts = question.front() == k_set_mark ? held.sets : held.defines;
        texts.emplace_back(question.substr(1, end - 1));
        question.remove_prefix(end + 1);
    }
    return held;
}

/// Silences standard error: drivers print there, and the window's own load has printed the warnings.
void be_quiet() {
    if (const int nothing = ::open("/dev/null", O_WRONLY | O_CLOEXEC); nothing >= 0)
        ::dup2(nothing, STDERR_FILENO);
}

/// Returns whether a message waits or the window has closed the socket. During a try both mean that it is
/// cancelled.
bool has_word(int socket) {
    pollfd wait{socket, POLLIN, 0};
    return ::poll(&wait, 1, 0) != 0;
}

/// Returns what is wrong; empty: nothing.
std::string tried(const Rehearsal::Play& play, const HeldTexts& held, uint64_t memory, int socket) {
    const auto run = run_forked(
        [&](const Tell&) {
            be_quiet();
            play(held);
        },
        {.memory = memory, .unwanted = [socket] { return has_word(socket); }});
    if (!run)
        return run.error().message;
    if (run->over_memory)
        return fmt::format("{} takes more than {} of memory (--memory)",
                           run->doing.empty() ? "the scene" : run->doing, memory_text(memory));
    return run->crash;
}

[[noreturn]] void be_child(pid_t parent, int socket, const Rehearsal::Play& play, uint64_t memory) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent)
        ::_exit(128 + SIGKILL);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) // the window decides when this process ends
        std::signal(signal, SIG_IGN);
    Doing::note_on(DoingPage::make());
    while (true) {
        std::string message(k_longest_message, '\0');
        const ssize_t count = ::recv(socket, message.data(), message.size(), 0);
        if (count == 0 || (count < 0 && errno != EINTR))
            ::_exit(0);
        if (count < 0 || message.front() != k_try) // the cancellation crossed the answer
            continue;
        message.resize(size_t(count));
        std::string answer = tried(play, held_in(message), memory, socket);
        answer.resize(std::min(answer.size(), k_longest_message));
        if (answer.empty())
            answer = k_well;
        if (::send(socket, answer.data(), answer.size(), MSG_NOSIGNAL) < 0)
            ::_exit(0);
    }
}

} // namespace

std::shared_ptr<Rehearsal> Rehearsal::start(const Play& play, uint64_t memory) {
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0)
        return nullptr;
    const pid_t parent = ::getpid();
    const pid_t child = ::fork();
    if (child == 0) {
        ::close(ends[0]);
        be_child(parent, ends[1], play, memory);
    }
    ::close(ends[1]);
    if (child < 0) {
        ::close(ends[0]);
        return nullptr;
    }
    return std::shared_ptr<Rehearsal>(new Rehearsal(child, ends[0]));
}

Rehearsal::~Rehearsal() {
    ::close(socket_);
    ::kill(child_, SIGKILL); // kills the try in progress, too
    while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

Result<void> Rehearsal::try_out(const HeldTexts& held, const std::function<bool()>& unwanted) {
    const std::lock_guard lock(one_);
    const std::string asked = question(held);
    if (asked.size() > k_longest_message)
        return fail(
            ErrorCode::load,
            fmt::format(
                "the values given for knobs and definitions have {} bytes: at most {} can be tried out",
                asked.size(), k_longest_message));
    const auto gone = [] { return fail(ErrorCode::load, "the process that tries scenes out has ended"); };
    if (::send(socket_, asked.data(), asked.size(), MSG_NOSIGNAL) < 0)
        return gone();
    for (bool told = false;;) { // whether it was cancelled
        pollfd wait{socket_, POLLIN, 0};
        if (::poll(&wait, 1, k_look_ms) <= 0) {
            told = told || (unwanted() && ::send(socket_, &k_enough, 1, MSG_NOSIGNAL) > 0);
            continue;
        }
        std::string answer(k_longest_message, '\0');
        const ssize_t count = ::recv(socket_, answer.data(), answer.size(), 0);
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0)
            return gone();
        answer.resize(size_t(count));
        if (answer.front() == k_well)
            return {};
        return fail(ErrorCode::load, std::move(answer));
    }
}

} // namespace tidemark::window
