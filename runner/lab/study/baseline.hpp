// Compares a study with an older one of the same scene: the settings that became slower or more wrong, beyond
// noise.
#pragma once

#include "base/result.hpp"
#include "lab/study/work_precision.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tidemark::lab {

struct Comparison {
    std::vector<std::string> worse; ///< one sentence each
    std::vector<std::string> notes; ///< comparisons that were not possible, and why
    size_t compared = 0; ///< number of points in both
};

/// `old_study` is a study.json; points are matched by label. Slower: by more than 5 %, with intervals that do
/// not overlap. More wrong: by more than 1 % and more than the reference's own error, or now NaN. Fails
/// (ErrorCode::load) if the text is not a study, or is one of other views or another size.
Result<Comparison> compare_with(std::string_view old_study, const std::string& file,
                                const WorkPrecisionSet& set);

} // namespace tidemark::lab
