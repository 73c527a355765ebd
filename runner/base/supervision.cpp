#include "base/supervision.hpp"

#include <poll.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <climits>
#include <csignal>
#include <cstring>
#include <new>

namespace tidemark {
namespace {

/// A registered file or child. A signal handler reads it, which can neither lock nor allocate.
struct Slot {
    static constexpr pid_t k_free = 0, k_in_hand = -1;
    std::atomic<pid_t> owner = k_free; ///< a forked child does not clean up for its parent
    pid_t child = 0;                   ///< 0: this is a file
    std::array<char, PATH_MAX> path{};
};

using Slots = std::array<Slot, 128>; // a report has about a hundred pictures under construction at once

/// Returns the slots shared by a process and all its forks, which may end without cleaning up.
Slots& slots() {
    static Slots* const shared = [] {
        void* const memory =
            ::mmap(nullptr, sizeof(Slots), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        return memory == MAP_FAILED ? new Slots : new (memory) Slots;
    }();
    return *shared;
}

std::atomic<bool> process_ends = false;
constexpr int k_last_moment_ms = 2;
constexpr int k_interrupted = 130; ///< as shells report SIGINT

/// Returns -1 if all slots are taken.
int take(const char* path, pid_t child) {
    while (process_ends)
        ::pause(); // another thread is about to end the process
    for (Slot& slot : slots()) {
        pid_t free = Slot::k_free;
        if (!slot.owner.compare_exchange_strong(free, Slot::k_in_hand))
            continue;
        slot.child = child;
        std::strncpy(slot.path.data(), path, PATH_MAX - 1);
        slot.owner = ::getpid();
        return int(&slot - slots().data());
    }
    return -1;
}

void remove_files(pid_t self) {
    for (const Slot& slot : slots())
        if (slot.owner == self && slot.child == 0)
            ::unlink(slot.path.data());
}

/// Ends the children first, since they may be about to make a file.
void clear() {
    process_ends = true;
    const pid_t self = ::getpid();
    for (const Slot& slot : slots())
        if (slot.owner == self && slot.child > 0) {
            ::kill(-slot.child, SIGKILL);
            while (::waitpid(slot.child, nullptr, 0) < 0 && errno == EINTR) {
            }
        }
    remove_files(self);
    // another thread may have registered a path and not made its file yet
    ::poll(nullptr, 0, k_last_moment_ms);
    remove_files(self);
}

} // namespace

Leftover Leftover::file(const std::filesystem::path& path) {
    Leftover leftover;
    if (path.native().size() < PATH_MAX)
        leftover.slot_ = take(path.c_str(), 0);
    return leftover;
}

Leftover Leftover::child(pid_t process) {
    Leftover leftover;
    leftover.slot_ = take("", process);
    return leftover;
}

void Leftover::forget() {
    if (slot_ >= 0)
        slots()[size_t(std::exchange(slot_, -1))].owner = Slot::k_free;
}

void exit_at_once(int code) {
    clear();
    ::_exit(code);
}

void clear_leftovers_of_the_dead() {
    for (Slot& slot : slots()) {
        const pid_t owner = slot.owner;
        if (owner <= 0 || owner == ::getpid() || ::kill(owner, 0) == 0)
            continue;
        if (slot.child == 0)
            ::unlink(slot.path.data());
        slot.owner = Slot::k_free;
    }
}

void clear_leftovers_on_signals() {
    slots(); // allocates it before a handler needs it
    struct sigaction action {};
    action.sa_handler = [](int signal) {
        clear();
        if (signal != SIGQUIT)
            ::_exit(k_interrupted);
        ::raise(signal); // leaves a core: SA_RESETHAND
    };
    action.sa_flags = int(SA_RESETHAND);
    sigemptyset(&action.sa_mask);
    for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGTERM}) {
        struct sigaction before {};
        ::sigaction(signal, nullptr, &before);
        if (before.sa_handler == SIG_DFL)
            ::sigaction(signal, &action, nullptr);
    }
}

namespace {

/// One per process, not per thread: a crash ends the whole process, whichever thread it happens on.
std::atomic<DoingPage*> the_page = nullptr;

int64_t now_nanoseconds() {
    return std::chrono::steady_clock::now().time_since_epoch().count();
}

} // namespace

DoingPage* DoingPage::make() {
    void* memory =
        ::mmap(nullptr, sizeof(DoingPage), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    return memory == MAP_FAILED ? nullptr : new (memory) DoingPage{};
}

/// A text that changes while it is read comes out mixed, which is acceptable in a message.
DoingPage::Seen DoingPage::seen() const {
    const size_t size = std::min<size_t>(size_, k_longest);
    if (size == 0)
        return {};
    return {std::string(what_, size), double(now_nanoseconds() - since_) / 1e9, starting_};
}

std::optional<DoingPage::Frame> DoingPage::frame() const {
    const int number = frame_;
    return number == k_no_frame ? std::nullopt : std::optional(Frame{number, begun_});
}

void DoingPage::note(std::string_view what, int64_t since, bool starting) {
    size_ = 0;
    what.copy(what_, k_longest);
    since_ = since;
    starting_ = starting;
    has_driver_ = has_driver_ || starting;
    size_ = uint32_t(std::min(what.size(), k_longest));
}

Doing::Doing(std::string_view what, Kind kind) {
    DoingPage* page = the_page;
    if (!page)
        return;
    before_ = page->seen();
    since_before_ = page->since_;
    page->note(what, now_nanoseconds(), kind == Kind::start);
}

Doing::~Doing() {
    if (DoingPage* page = the_page)
        page->note(before_.what, since_before_, before_.starting);
}

void Doing::note_on(DoingPage* page) {
    the_page = page;
}

void Doing::note_frame(std::optional<DoingPage::Frame> frame) {
    DoingPage* page = the_page;
    if (!page)
        return;
    page->begun_ = frame && frame->begun;
    page->frame_ = frame ? frame->number : DoingPage::k_no_frame;
}

void Doing::note_resumable() {
    if (DoingPage* page = the_page)
        page->resumable_ = true;
}

std::string Doing::left_behind() {
    DoingPage* page = the_page;
    if (!page)
        return {};
    std::string what = page->seen().what;
    page->note({}, 0, false);
    return what;
}

} // namespace tidemark
