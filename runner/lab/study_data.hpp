// Results of a study for other programs: JSON, CSV, and the comparison with an older study.
//
// Cleans texts from a scene or a study file for files that other programs read line by line.
#pragma once

#include "base/error.hpp"
#include "lab/work_precision.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace tidemark::lab {

/// Returns the text with each control character, including line breaks, replaced by a blank. Other bytes
/// stay.
inline std::string one_line(std::string_view text) {
    std::string plain(text);
    for (char& c : plain)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
            c = ' ';
    return plain;
}

// A study as data for other programs: JSON with everything, CSV with a row for each point and view. Returns
// text.

inline constexpr const char* k_study_schema = "tidemark study 1";

/// The format is described in runner/cli/manual/study.md, "Results". NaN and infinity are null.
std::string to_json(const WorkPrecisionSet& set);

/// Returns one row for each point and view, and one for all views together.
std::string to_csv(const WorkPrecisionSet& set);

// Compares a study with an older one of the same scene: the settings that became slower or more wrong, beyond
// noise.

struct Comparison {
    std::vector<std::string> worse; ///< one sentence each
    std::vector<std::string> notes; ///< comparisons that were not possible, and why
    size_t compared = 0;            ///< number of points in both
};

/// `old_study` is a study.json; points are matched by label. Slower: by more than 5 %, with intervals that do
/// not overlap. More wrong: by more than 1 % and more than the reference's own error, or now NaN. Fails
/// (ErrorCode::load) if the text is not a study, or is one of other views or another size.
Result<Comparison> compare_with(std::string_view old_study, const std::string& file,
                                const WorkPrecisionSet& set);

} // namespace tidemark::lab
