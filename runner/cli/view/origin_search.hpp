// Traces the origin of a NaN: runs `check --trace` in a separate process while the window goes on.
#pragma once

#include "base/error.hpp"
#include "base/result.hpp"

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace tidemark::cli {

/// Returns the output of `check --trace --json` as an error at the line to fix.
Error origin_of(const std::string& json);

class OriginSearch {
public:
    /// Starts this program with those arguments. `wake` is called on another thread when `take` has a result.
    /// Fails where the process cannot be started.
    static Result<std::unique_ptr<OriginSearch>> start(const std::vector<std::string>& words,
                                                       std::function<void()> wake);
    /// Kills the process.
    ~OriginSearch();
    OriginSearch(const OriginSearch&) = delete;
    OriginSearch& operator=(const OriginSearch&) = delete;

    /// Returns the output of the process once it has ended.
    std::optional<std::string> take();

private:
    OriginSearch(int process, int pipe, std::function<void()> wake);

    int process_;
    std::string printed_;
    std::atomic<bool> done_ = false;
    std::thread reader_;
};

} // namespace tidemark::cli
