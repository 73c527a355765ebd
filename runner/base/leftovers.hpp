// What must not outlive a process that ends early, by a signal or by a driver that cannot be waited for:
// files under construction are removed, programs that were started are ended.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <utility>

namespace tidemark {

/// Holds one such thing in mind while it lives. More than a hundred or so at once are not minded.
class Leftover {
public:
    Leftover() = default;
    /// Before the file is made.
    static Leftover file(const std::filesystem::path& path);
    /// The leader of a process group.
    static Leftover child(pid_t process);

    Leftover(Leftover&& other) noexcept : slot_(std::exchange(other.slot_, -1)) {}
    Leftover& operator=(Leftover&& other) noexcept {
        std::swap(slot_, other.slot_);
        return *this;
    }
    ~Leftover() { forget(); }
    void forget();

private:
    int slot_ = -1;
};

/// Instead of `exit` and its destructors.
[[noreturn]] void exit_at_once(int code);

/// What processes minded that were forked from this one and have ended: a crash or SIGKILL leaves no time for
/// it.
void clear_leftovers_of_the_dead();

/// To be called before the first fork. SIGHUP, SIGINT, SIGQUIT and SIGTERM take what is minded with them,
/// where nobody else asked for them, and end the process with 130, SIGQUIT with a core. One that is ignored
/// stays so.
void clear_leftovers_on_signals();

} // namespace tidemark
