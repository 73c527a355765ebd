// Cleans up after a process that ends early, by a signal or because a driver hangs: removes files under
// construction and kills started programs.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <utility>

namespace tidemark {

/// Registers one file or child while it lives. Beyond 128 at once, further ones are not registered.
class Leftover {
public:
    Leftover() = default;
    /// Registers a file; to be called before the file is made.
    static Leftover file(const std::filesystem::path& path);
    /// Registers the leader of a process group.
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

/// Cleans up and exits without running destructors, unlike `exit`.
[[noreturn]] void exit_at_once(int code);

/// Removes the files registered by forked processes that have died, by a crash or SIGKILL, without cleaning
/// up. Does not end their children.
void clear_leftovers_of_the_dead();

/// Installs handlers of SIGHUP, SIGINT, SIGQUIT and SIGTERM that clean up and end the process with 130,
/// SIGQUIT with a core. A signal that is ignored or has a handler stays as it is. To be called before the
/// first fork.
void clear_leftovers_on_signals();

} // namespace tidemark
