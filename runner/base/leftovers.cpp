#include "base/leftovers.hpp"

#include <poll.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
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

} // namespace tidemark
