// A study held against an older one of the same scene: what became slower or more wrong, beyond noise.
#pragma once

#include "base/result.hpp"
#include "lab/study/work_precision.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tidemark::lab {

struct Comparison {
    std::vector<std::string> worse; ///< a sentence each
    std::vector<std::string> notes; ///< what could not be compared, and why
    size_t compared = 0;            ///< points that both have
};

/// `old_study` is a study.json; points are known by their labels. Slower: by more than 5 %, with intervals
/// that do not overlap. More wrong: by more than 1 % and more than the reference's own error, or no number
/// any more. Fails (ErrorCode::load) on a text that is no study, and on one of other views or another size.
Result<Comparison> compare_with(std::string_view old_study, const std::string& file,
                                const WorkPrecisionSet& set);

} // namespace tidemark::lab
