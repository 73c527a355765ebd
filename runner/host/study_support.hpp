// Shared parts of every study on the command line: progress and cancellation, metadata, and the report
// folder.
#pragma once

#include "base/error.hpp"
#include "base/file.hpp"
#include "base/measurement.hpp"
#include "host/command_line.hpp"
#include "host/console.hpp"
#include "host/devices.hpp"
#include "host/requests.hpp"
#include "host/supervision.hpp"
#include "lab/conduct.hpp"
#include "lab/tune.hpp"
#include "scene/scene.hpp"

#include <filesystem>
#include <memory>
#include <string>

namespace tidemark::host {

/// Prints progress for each part of the study, and cancels it on Ctrl-C or after a driver error. A context
/// must be current.
class StudyWatcher {
public:
    explicit StudyWatcher(Interrupt& interrupt) : interrupt_(interrupt) {}

    lab::Watch watch();
    /// Fails if the graphics driver was reset or ran out of memory: the measurements are then invalid.
    Result<void> finish();

private:
    bool goes_on();

    Interrupt& interrupt_;
    std::unique_ptr<Progress> progress_;
    Result<void> driver_; ///< first error of the driver, kept because the driver reports a reset only once
};

/// Returns the program's version, the time and the number of cores.
lab::Circumstances circumstances_now();

/// Returns these with the scene and the driver; a context must be current.
lab::Circumstances circumstances_of(const scene::Scene& scene);

/// Makes the folder and checks that it is writable, before hours of measuring. Its content stays until the
/// new report is complete.
Result<void> prepare_report(const OutputPath& folder);

/// Writes the report into `folder`, or into FOLDER-interrupted if an interrupted study would replace a
/// complete one. Returns the folder used.
Result<std::filesystem::path> write_findings(const OutputPath& folder, const lab::Findings& findings);

/// Prints the path of the report's page.
void say_report(const std::filesystem::path& folder);

/// Prints sentences, remarks, and the path of the report.
void say_findings(const lab::WorkPrecisionSet& set, const std::filesystem::path& folder);

// The command-line options that `tune` and `simplify` share.

struct SearchOptions {
    SceneRequest scene;
    std::string most_error;  ///< parsed by each command in its own way
    std::string usual_views; ///< default views of the command
    /// Default views for a scene with feedback, which needs all earlier frames to be drawn.
    std::string early_views;
    std::string views; ///< empty: the defaults above
    std::string size;
    double seconds = 60;
    std::string output; ///< folder of the report
    bool write = false;
    bool json = false;
    DeviceChoice device{};
};

/// Adds all options except the scene and the goal, as the last options of a command.
void add_search_options(Command command, SearchOptions& options);

/// Returns the request with views, size and seconds; the caller adds the goal.
Result<lab::SearchRequest> search_request(const SearchOptions& options, const scene::Scene& scene);

} // namespace tidemark::host
