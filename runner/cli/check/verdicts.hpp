// Formats the results of probes as text, as JSON and as findings.
#pragma once

#include "cli/check/check_probes.hpp"
#include "cli/check/probe_result.hpp"
#include "cli/finding.hpp"

#include <span>
#include <string>

namespace tidemark::cli {

/// Returns true for a failure or a warning.
bool is_finding(const lab::Answer& answer);

/// Returns the command that draws the frame in which a probe found something; empty if it found nothing, or
/// in no particular frame.
std::string reproduction(const ProbesRequest& request, const ProbeResult& asked);

/// Returns the counts, for example `2 fail, 1 warn, 14 pass, 12 n/a`.
std::string counted(std::span<const ProbeResult> all);

/// Returns a result with all its details; empty for those that are listed in `summary`.
std::string row(const ProbesRequest& request, const ProbeResult& asked);

/// Returns the same for --diagnostics, placed at the operation that a trace found, otherwise at the pass's
/// mainImage.
Finding finding(const scene::Scene& scene, const ProbeResult& asked);

/// Returns the probes that did not apply or were cut, one line for each reason, and the counts; `seconds` is
/// the total time.
std::string summary(std::span<const ProbeResult> all, double seconds);

/// Returns all results as JSON.
std::string report(const ProbesRequest& request, std::span<const ProbeResult> all);

/// Returns the exit code of the command: a failure takes precedence over probes that were cut.
int exit_code(std::span<const ProbeResult> all);

} // namespace tidemark::cli
