// Progress of a long command on standard error: one line that is overwritten on a terminal, otherwise a line
// for each tenth. Nothing is shown in the first seconds.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace tidemark::cli {

class Progress {
public:
    struct Manner {
        double silent = 2;   ///< seconds before the first line
        double between = 10; ///< seconds after which a line is due even within a tenth
        /// Set where pieces take unpredictable time: no rate is computed, only the time left until the latest
        /// end is shown. Seconds from the start.
        std::optional<double> limit{};
    };
    /// `what` is the unit that is counted, for example "frames".
    Progress(std::string what, size_t total, Manner manner);
    Progress(std::string what, size_t total) : Progress(std::move(what), total, Manner()) {}
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void advance();
    /// Clears the line on a terminal, so that other output can be printed.
    void step_aside();

private:
    std::string line() const;

    std::string what_;
    size_t total_;
    Manner manner_;
    size_t done_ = 0;
    bool on_terminal_ = false; ///< a line is shown
    bool terminal_;
    std::chrono::steady_clock::time_point start_;
    std::chrono::steady_clock::time_point shown_;
    std::chrono::steady_clock::time_point first_done_;
};

} // namespace tidemark::cli
