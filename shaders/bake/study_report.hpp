// Error of the fast marching against its run time, on maps with known answers: as a table and, with a folder,
// as a report like that of `tidemark study`.
#pragma once

#include "base/error.hpp"

#include <filesystem>

namespace tidemark::bake {

struct MarchStudyRequest {
    std::filesystem::path folder; ///< of the report; empty: print only the table
    double budget = 30;           ///< seconds for the timing
};

/// Returns the exit code.
Result<int> study_march(const MarchStudyRequest& request);

} // namespace tidemark::bake
