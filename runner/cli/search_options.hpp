// The command-line options that `tune` and `simplify` share.
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
    std::string most_error;  ///< parsed by each command in its own way
    std::string usual_views; ///< default views of the command
    /// Default views for a scene with feedback, which needs all earlier frames to be drawn.
    std::string early_views;
    std::string views;       ///< empty: the defaults above
    std::string size;
    double seconds = 60;
    std::string output; ///< folder of the report
    bool write = false;
    bool json = false;
    platform::DeviceChoice device{};
};

/// Adds all options except the scene and the goal, as the last options of a command.
void add_search_options(Command command, SearchOptions& options);

/// Returns the request with views, size and seconds; the caller adds the goal.
Result<lab::SearchRequest> search_request(const SearchOptions& options, const scene::Scene& scene);

} // namespace tidemark::cli
