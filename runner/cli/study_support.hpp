// Shared parts of every study on the command line: progress and cancellation, metadata, and the report
// folder.
#pragma once

#include "base/output_path.hpp"
#include "base/result.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "lab/study/conduct.hpp"
#include "lab/watch.hpp"
#include "scene/scene.hpp"

#include <filesystem>
#include <memory>

namespace tidemark::cli {

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
/// complete one. Returns the folder used; parts that could not be made (no gnuplot) are added to the remarks.
Result<std::filesystem::path> write_findings(const OutputPath& folder, lab::Findings& findings);

/// Prints the path of the report's page.
void say_report(const std::filesystem::path& folder);

/// Prints sentences, remarks, and the path of the report.
void say_findings(const lab::WorkPrecisionSet& set, const std::filesystem::path& folder);

} // namespace tidemark::cli
