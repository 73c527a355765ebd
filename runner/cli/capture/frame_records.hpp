// What became of the frames of a capture: one by one where --json or a sheet lists them, else as much as is
// told of them at the end, in the same memory however many they are.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tidemark::cli {

/// What became of one frame. What it showed is asked of its number anew: of 10,000 frames their states would
/// be 30 MB.
struct FrameRecord {
    int frame = 0;
    std::string file;
    std::string sha256;
    double milliseconds = 0;
    size_t not_finite = 0;   ///< pixels
    size_t no_coverage = 0;  ///< pixels of an alpha that is kept and below 0 or above 1
    size_t passes_drawn = 0; ///< on the way to it too; 0: it is the frame before
};

class FrameRecords {
public:
    /// Frames that have something: the first of them.
    struct Found {
        std::optional<FrameRecord> first{};
        size_t count = 0;
    };

    /// `listed`: each is kept.
    explicit FrameRecords(bool listed) : listed_(listed) {}

    void add(FrameRecord record);

    size_t count() const { return count_; }
    /// There must be one.
    const FrameRecord& first() const { return *first_; }
    const FrameRecord& last() const { return *last_; }
    const Found& not_finite() const { return not_finite_; }
    const Found& no_coverage() const { return no_coverage_; }
    /// All of them where they are listed, else none.
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
