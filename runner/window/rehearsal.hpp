// A helper process that first tries what may be too much for the driver. Each try runs in a further process,
// which may crash, use all of its allowed memory, or be cancelled.
#pragma once

#include "base/error.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace tidemark::cli {

/// Current values of --set and --define, `NAME=VALUE` each.
struct HeldTexts {
    std::vector<std::string> sets;
    std::vector<std::string> defines;
};

class Rehearsal {
public:
    using Play = std::function<void(const HeldTexts& held)>;
    /// Starts the helper. Call it before this process has an OpenGL context or threads. `play` is the work of
    /// each try, in a process that shares nothing with this one; `memory` in bytes, 0: no limit. Returns
    /// nullptr where no process can be started.
    static std::shared_ptr<Rehearsal> start(const Play& play, uint64_t memory);
    Rehearsal(const Rehearsal&) = delete;
    Rehearsal& operator=(const Rehearsal&) = delete;
    /// Kills the helper and the try in progress.
    ~Rehearsal();

    /// Runs one try and waits for it; fails (ErrorCode::load) if it crashed or used too much memory. Returns
    /// early, with any result, once `unwanted` returns true. May be called from any thread; calls run one at
    /// a time.
    Result<void> try_out(const HeldTexts& held, const std::function<bool()>& unwanted);

private:
    Rehearsal(int child, int socket) : child_(child), socket_(socket) {}

    int child_;
    int socket_;
    std::mutex one_;
};

} // namespace tidemark::cli
