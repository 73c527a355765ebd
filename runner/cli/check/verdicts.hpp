// What probes answered, as people and as scripts read it.
#pragma once

#include "cli/check/check_probes.hpp"
#include "cli/check/probe_result.hpp"
#include "cli/finding.hpp"

#include <span>
#include <string>

namespace tidemark::cli {

/// Whether there is something to show.
bool is_finding(const lab::Answer& answer);

/// The command that draws the frame in which a probe found something; empty: it found nothing, or in no
/// frame.
std::string reproduction(const ProbesRequest& request, const ProbeResult& asked);

/// `2 fail, 1 warn, 14 pass, 12 n/a`.
std::string counted(std::span<const ProbeResult> all);

/// A verdict with all that belongs to it. Empty for those that wait for `rest`.
std::string row(const ProbesRequest& request, const ProbeResult& asked);

/// The same for --diagnostics: at the operation that a trace found, else at the pass's mainImage.
Finding finding(const scene::Scene& scene, const ProbeResult& asked);

/// Those that did not apply or were cut, one line for each reason, and the sum of it all, which took so many
/// `seconds`.
std::string summary(std::span<const ProbeResult> all, double seconds);

/// All of it as JSON.
std::string report(const ProbesRequest& request, std::span<const ProbeResult> all);

/// Of the command. A failure is one even where other probes were cut.
int exit_code(std::span<const ProbeResult> all);

} // namespace tidemark::cli
