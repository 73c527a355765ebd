// How far a long command is, for a person watching: one line that rewrites itself on a terminal, a line for
// each tenth otherwise. Writes to standard error.
#pragma once

#include <chrono>
#include <string>

namespace tidemark::cli {

class Progress {
public:
    /// `what` is counted, as in "frames".
    Progress(std::string what, size_t total);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void advance();

private:
    std::string line() const;

    std::string what_;
    size_t total_;
    size_t done_ = 0;
    bool terminal_;
    std::chrono::steady_clock::time_point start_;
    std::chrono::steady_clock::time_point shown_;
    std::chrono::steady_clock::time_point first_done_;
};

} // namespace tidemark::cli
