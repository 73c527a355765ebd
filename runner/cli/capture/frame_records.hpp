// The results of a capture's frames: each one where --json or a sheet lists them, otherwise only what the
// final messages need, in constant memory.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tidemark::cli {

/// The result of one frame. Its state is not stored but computed again from its number: the states of 10,000
/// frames would take 30 MB.
struct FrameRecord {
    int frame = 0;
    std::string file;
    std::string sha256;
    double milliseconds = 0;
    size_t not_finite = 0;   ///< pixels
    size_t no_coverage = 0;  ///< pixels with an alpha below 0 or above 1, where alpha is kept
    size_t passes_drawn = 0; ///< including the frames that lead to it; 0: same picture as the frame before
};

class FrameRecords {
public:
    /// Frames with a certain property: the first one and their number.
    struct Found {
        std::optional<FrameRecord> first{};
        size_t count = 0;
    };

    /// `listed`: keep each record.
    explicit FrameRecords(bool listed) : listed_(listed) {}

    void add(FrameRecord record);

    size_t count() const { return count_; }
    /// Requires at least one frame.
    const FrameRecord& first() const { return *first_; }
    const FrameRecord& last() const { return *last_; }
    const Found& not_finite() const { return not_finite_; }
    const Found& no_coverage() const { return no_coverage_; }
    /// All records if `listed`, otherwise none.
    const std::vector<FrameRecord>& list() const { return list_; }

private:
    bool listed_;
    size_t count_ = 0;
    std::optional<FrameRecord> first_;
    std::optional<FrameRecord> last_;
    Found not_finite_;
    Found no_coverage_;
    std::vector<FrameRecord> list_;
};

} // namespace tidemark::cli
