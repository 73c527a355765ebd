// What every search for a better scene (`tune`, `simplify`) is asked on the command line.
#pragma once

#include "base/result.hpp"
#include "cli/command_line.hpp"
#include "cli/requests.hpp"
#include "lab/tune/search.hpp"
#include "platform/device_choice.hpp"

#include <string>

namespace tidemark::cli {

struct SearchOptions {
    SceneRequest scene;
    std::string most_error;  ///< each search reads it in its own way
    std::string usual_views; ///< of each search its own
    std::string early_views; ///< where each frame leads to the next, so that all before one are drawn for it
    std::string views;       ///< empty: those
    std::string size;
    double seconds = 60;
    std::string output; ///< folder of the report
    bool write = false;
    bool json = false;
    platform::DeviceChoice device{};
};

/// All but the scene and the goal, as the last options of a command.
void add_search_options(Command command, SearchOptions& options);

/// Views, size and seconds; the goal is left to the caller.
Result<lab::SearchRequest> search_request(const SearchOptions& options, const scene::Scene& scene);

} // namespace tidemark::cli
