#include "cli/capture/frame_records.hpp"

#include <utility>

namespace tidemark::cli {
namespace {

void find(FrameRecords::Found& found, size_t pixels, const FrameRecord& record) {
    if (pixels == 0)
        return;
    ++found.count;
    if (!found.first)
        found.first = record;
}

} // namespace

void FrameRecords::add(FrameRecord record) {
    ++count_;
    if (!first_)
        first_ = record;
    find(not_finite_, record.not_finite, record);
    find(no_coverage_, record.no_coverage, record);
    if (listed_)
        list_.push_back(record);
    last_ = std::move(record);
}

} // namespace tidemark::cli
