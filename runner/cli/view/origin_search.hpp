// The search for where a NaN has its origin, beside the window: `check --trace` in a process of its own, one
// at a time.
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

/// What `check --trace --json` printed, as an error at the line to mend.
Error origin_of(const std::string& json);

class OriginSearch {
public:
    /// Starts this program with those words. `wake` is called on another thread when there is something to
    /// `take`. Fails where no process is to be had.
    static Result<std::unique_ptr<OriginSearch>> start(const std::vector<std::string>& words,
                                                       std::function<void()> wake);
    /// Ends the process.
    ~OriginSearch();
    OriginSearch(const OriginSearch&) = delete;
    OriginSearch& operator=(const OriginSearch&) = delete;

    /// What the process printed, when it is done.
    std::optional<std::string> take();

private:
    OriginSearch(int process, int pipe, std::function<void()> wake);

    int process_;
    std::string printed_;
    std::atomic<bool> done_ = false;
    std::thread reader_;
};

} // namespace tidemark::cli
