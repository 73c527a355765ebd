// What this process has a driver do at the moment, written where the process that supervises it can still
// read it when a driver has crashed. Comes in as words, goes out as words; nothing is decided here.
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace tidemark {

/// A page that is shared with the processes forked after it was made. Lives as long as the process.
class DoingPage {
public:
    /// nullptr where the system has no page left: then nothing is noted.
    static DoingPage* make();

    struct Seen {
        std::string what;      ///< empty: no driver is at work
        double seconds = 0;    ///< since when
        bool starting = false; ///< the driver itself is being started
    };
    Seen seen() const;
    /// Whether a driver was ever started: then it has threads of its own.
    bool has_driver() const { return has_driver_; }
    /// The frame of a capture that is in hand, from being drawn until the next one is; not begun: the first
    /// is next.
    struct Frame {
        int number = 0;
        bool begun = false;
    };
    std::optional<Frame> frame() const;
    /// Whether what is cut short can be gone on with.
    bool resumable() const { return resumable_; }

private:
    friend class Doing;
    void note(std::string_view what, int64_t since, bool starting);

    static constexpr size_t k_longest = 480;
    static constexpr int k_no_frame = std::numeric_limits<int>::min();
    std::atomic<uint32_t> size_;
    std::atomic<bool> starting_;
    std::atomic<bool> has_driver_;
    std::atomic<bool> resumable_;
    std::atomic<int> frame_ = k_no_frame;
    std::atomic<bool> begun_;
    std::atomic<int64_t> since_; ///< nanoseconds of the steady clock
    char what_[k_longest];
};

/// Notes what a driver does until it is destroyed; then what it did before goes on.
class Doing {
public:
    enum class Kind { work, start };

    /// `what` completes "the driver crashed …", as in "compiling Image of 'waves.glsl'".
    explicit Doing(std::string_view what, Kind kind = Kind::work);
    ~Doing();
    Doing(const Doing&) = delete;
    Doing& operator=(const Doing&) = delete;

    /// Where everything of this process is noted from now on; nullptr: nowhere.
    static void note_on(DoingPage* page);
    /// Which frame of a capture is in hand from now on; nothing: none is.
    static void note_frame(std::optional<DoingPage::Frame> frame);
    /// What is cut short from now on can be gone on with.
    static void note_resumable();
    /// What a process that noted on the same page, and has crashed since, was at; it is at nothing any more.
    static std::string left_behind();

private:
    DoingPage::Seen before_;
    int64_t since_before_ = 0;
};

} // namespace tidemark
