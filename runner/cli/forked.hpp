// Work in a process of its own, for what may crash or never end: a driver that compiles a hostile shader. To
// be called before the program has an OpenGL context or threads, but that of an Interrupt.
#pragma once

#include "base/result.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace tidemark::cli {

struct ForkedResult {
    std::string output;       ///< all that the work told, whole lines only
    bool timed_out = false;   ///< it was ended after `seconds`
    bool over_memory = false; ///< or when it had taken more memory than it may
    bool unwanted = false;    ///< or because nobody wanted it any more
    std::string crash{};      ///< or how something in it, a driver, ended it; empty: it came to its end
    std::string doing{};      ///< where it did not come to its end: what a driver was at, if one was
};

/// Tells one line to the parent; what was told survives the end of the work.
using Tell = std::function<void(std::string_view line)>;

/// What ends the work before its own end. `unwanted` is asked some twenty times a second, where there is one.
struct ForkedLimits {
    double seconds = 0;
    uint64_t memory = 0; ///< bytes; 0: none
    std::function<bool()> unwanted{};
};

/// Runs `work` in a child and waits for it; `hear` is called with each line as it comes, and the work waits
/// meanwhile.
Result<ForkedResult> run_forked(
    const std::function<void(const Tell&)>& work, const ForkedLimits& limits,
    const Tell& hear = [](std::string_view) {});
inline Result<ForkedResult> run_forked(
    const std::function<void(const Tell&)>& work, double seconds,
    const Tell& hear = [](std::string_view) {}) {
    return run_forked(work, ForkedLimits{.seconds = seconds}, hear);
}

/// A child made early, while it may be, that sleeps until its work is asked for.
class ForkedHelper {
public:
    using Work = std::function<void(const std::string& question, const Tell&)>;
    static Result<ForkedHelper> start(const Work& work);
    ForkedHelper(ForkedHelper&& other) noexcept;
    ForkedHelper& operator=(ForkedHelper&&) = delete;
    /// Ends a child that was not asked.
    ~ForkedHelper();

    /// Once, with one line: gives the child its question and waits for it; `hear` as in run_forked.
    Result<ForkedResult> ask(
        std::string_view question, const ForkedLimits& limits, const Tell& hear = [](std::string_view) {});
    Result<ForkedResult> ask(
        std::string_view question, double seconds, const Tell& hear = [](std::string_view) {}) {
        return ask(question, ForkedLimits{.seconds = seconds}, hear);
    }

    /// `ask` in steps, for who has other things to wait for: `begin` once, then `look` whenever there is
    /// something to read from `descriptor`, or time has passed. It hears what was told, waits for it at most
    /// so long, and gives the result once the work has ended.
    void begin(std::string_view question, const ForkedLimits& limits);
    int descriptor() const { return answer_; }
    std::optional<ForkedResult> look(const Tell& hear, std::chrono::milliseconds wait);

private:
    struct Asked {
        ForkedLimits limits;
        std::chrono::steady_clock::time_point deadline;
        ForkedResult result{};
        size_t heard = 0; ///< of its output
    };

    ForkedHelper() = default;
    void hear_lines(const Tell& hear);
    ForkedResult finish(bool ended);

    std::optional<Asked> asked_{};
    int child_ = -1;    ///< -1: no more to be waited for
    int question_ = -1; ///< to the child
    int answer_ = -1;   ///< from it
};

} // namespace tidemark::cli
