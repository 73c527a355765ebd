// What every study on the command line needs: who watches it, and what is noted of the day.
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

/// A line of progress for each part of the study, and an end to it where nobody wants it or the driver
/// cannot. A context must be current.
class StudyWatcher {
public:
    explicit StudyWatcher(Interrupt& interrupt) : interrupt_(interrupt) {}

    lab::Watch watch();
    /// Fails where the graphics driver was reset, or had no memory: nothing of what was measured counts then.
    Result<void> finish();

private:
    bool goes_on();

    Interrupt& interrupt_;
    std::unique_ptr<Progress> progress_;
    Result<void> driver_; ///< as it was when last asked: it tells of a reset once
};

/// The program, the moment and the machine's cores.
lab::Circumstances circumstances_now();

/// These, the scene and the driver; a context must be current.
lab::Circumstances circumstances_of(const scene::Scene& scene);

/// The folder is made before anything is measured, so that an hour's work has a place to go. What is in it
/// stays until the new report is whole.
Result<void> prepare_report(const OutputPath& folder);

/// The report goes into `folder`, but that an interrupted study does not take the place of a finished one and
/// goes beside it, into FOLDER-interrupted. The folder that it went to; what could not be made (no gnuplot)
/// is added to the remarks.
Result<std::filesystem::path> write_findings(const OutputPath& folder, lab::Findings& findings);

/// Where its page is.
void say_report(const std::filesystem::path& folder);

/// Sentences and remarks for people, and where the report is.
void say_findings(const lab::WorkPrecisionSet& set, const std::filesystem::path& folder);

} // namespace tidemark::cli
