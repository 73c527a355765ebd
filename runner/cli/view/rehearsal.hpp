// A process beside the window's that tries out what may be too much for a driver: in one more process for
// each try, which may crash, take all the memory it is allowed, or be given up.
#pragma once

#include "base/result.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace tidemark::cli {

/// Values of --set and --define at the moment, `NAME=VALUE` each.
struct HeldTexts {
    std::vector<std::string> sets;
    std::vector<std::string> defines;
};

class Rehearsal {
public:
    using Play = std::function<void(const HeldTexts& held)>;
    /// To be called before this process has an OpenGL context or threads. `play` is what each try does, in a
    /// process that shares nothing with this one; `memory` in bytes, 0: no limit. nullptr where no process
    /// can be had.
    static std::shared_ptr<Rehearsal> start(const Play& play, uint64_t memory);
    Rehearsal(const Rehearsal&) = delete;
    Rehearsal& operator=(const Rehearsal&) = delete;
    /// Ends it, and what it has under way.
    ~Rehearsal();

    /// Waits for one try; fails (ErrorCode::load) where it crashed or took too much. Ends early, with any
    /// outcome, once `unwanted` says so. From any thread, one after the other.
    Result<void> try_out(const HeldTexts& held, const std::function<bool()>& unwanted);

private:
    Rehearsal(int child, int socket) : child_(child), socket_(socket) {}

    int child_;
    int socket_;
    std::mutex one_;
};

} // namespace tidemark::cli
