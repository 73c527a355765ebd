// `bake island --study`: error of the marching against its run time, on maps with known answers; as a table
// and, with a folder, as the same report that `tidemark study` writes.
#pragma once

#include "base/result.hpp"

#include <filesystem>

namespace tidemark::cli {

struct MarchStudyRequest {
    std::filesystem::path folder; ///< of the report; empty: the table alone
    double budget = 30;           ///< seconds for the timing
};

/// The process's exit code.
Result<int> study_march(const MarchStudyRequest& request);

} // namespace tidemark::cli
