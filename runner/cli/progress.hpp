// How far a long command is, for a person watching: one line that rewrites itself on a terminal, a line for
// each tenth otherwise, once it has taken as long as people notice. Writes to standard error.
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace tidemark::cli {

class Progress {
public:
    struct Manner {
        double silent = 2;   ///< seconds at first
        double between = 10; ///< seconds between two lines at most, where tenths take longer
        /// Of pieces that take as long as they take no rate is made: all that is known is when it ends at the
        /// latest, in seconds from its start.
        std::optional<double> limit{};
    };
    /// `what` is counted, as in "frames".
    Progress(std::string what, size_t total, Manner manner);
    Progress(std::string what, size_t total) : Progress(std::move(what), total, Manner()) {}
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void advance();
    /// Makes room on a terminal for a line of somebody else.
    void step_aside();

private:
    std::string line() const;

    std::string what_;
    size_t total_;
    Manner manner_;
    size_t done_ = 0;
    bool on_terminal_ = false; ///< a line stands there
    bool terminal_;
    std::chrono::steady_clock::time_point start_;
    std::chrono::steady_clock::time_point shown_;
    std::chrono::steady_clock::time_point first_done_;
};

} // namespace tidemark::cli
