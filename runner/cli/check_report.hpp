// Formats the trace of a NaN as text and as JSON.
#pragma once

#include "cli/check.hpp"
#include "host/devices.hpp"
#include "host/diagnostics.hpp"
#include "host/json.hpp"
#include "lab/nan_trace.hpp"
#include "lab/probes.hpp"
#include "scene/scene.hpp"

#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>

namespace tidemark::cli {

std::string to_text(const lab::NanTrace& trace);
nlohmann::ordered_json to_json(const lab::NanTrace& trace);

/// Returns the place of the first operation in the JSON of a trace; nothing if there is none, or if it is not
/// in a file.
std::optional<SourceLocation> origin_in(const nlohmann::ordered_json& trace);

// Traces a NaN (lab/nan_trace.hpp) in a child process, so that a crash of the driver or an endless
// shader is only an error.

/// The pixel or frame to trace, and the device to draw on.
struct TraceJob {
    host::DeviceChoice device{};
    lab::TraceRequest request;
    std::function<bool()> unwanted{}; ///< called some twenty times a second: returns true to end the trace
};

/// The best result reported before the end.
struct TraceFound {
    bool found = false;  ///< something is NaN or infinite
    std::string text{};  ///< report as text, whole lines
    host::Json json{};   ///< report as JSON; null if nothing was found
    std::string ended{}; ///< why the trace is incomplete; empty: it is complete
};

/// Traces in a child process; call it before this process has a context (host/forked.hpp). Fails if the scene
/// does not compile, or if nothing was found in time.
Result<TraceFound> trace_apart(const scene::Scene& scene, const TraceJob& job, double seconds);

// The result of one probe, and its JSON form, by which the child process sends it to its parent.

struct ProbeResult {
    const lab::Probe* probe;
    lab::Answer answer; ///< without its picture, which is in a file
    double seconds = 0;
    std::filesystem::path picture{}; ///< empty: no picture was written
    /// The origin of a NaN or infinity, or why it is unknown: as text with whole lines, and as JSON.
    std::string trace{};
    host::Json trace_json{};
};

host::Json to_json(const ProbeResult& asked);
/// Reads the output of to_json, with the errors and exceptions of frame_state_of.
Result<ProbeResult> result_of(const host::Json& line);

// Formats the results of probes as text, as JSON and as findings.

/// Returns the command that draws the frame in which a probe found something; empty if it found nothing, or
/// in no particular frame.
std::string reproduction(const ProbesRequest& request, const ProbeResult& asked);

/// One cause, and all that probes found of it.
struct JoinedFinding {
    lab::Verdict level = lab::Verdict::note;   ///< of its most serious result
    std::string message{};                     ///< what a viewer sees and why, as a sentence
    std::vector<SourceLocation> places{};      ///< the lines to change; empty: not known
    std::vector<const ProbeResult*> results{}; ///< the most serious first
    lab::Remedy remedy = lab::Remedy::none;    ///< what `command` does
    std::string command{};                     ///< fixes or shows it; empty: there is none
};

/// Joins the findings of one family that name a common line, or no line. The most serious comes first. The
/// results must outlive the answer.
std::vector<JoinedFinding> joined_findings(const ProbesRequest& request, std::span<const ProbeResult> all);

/// Returns for example `foam.glsl:9, 12 and 2 more`; empty without places.
std::string places_in_words(std::span<const SourceLocation> places);

/// Returns for example `2 failures, 1 warning, 3 notes`, or `nothing found`.
std::string counted(std::span<const JoinedFinding> findings);

/// Returns what the command prints: the findings, one line for the probes that passed, and the counts; with
/// `all` also notes and each probe's sentence. `seconds` is the total time.
std::string printed(const ProbesRequest& request, std::span<const ProbeResult> all, double seconds);

/// Returns a finding for --diagnostics, placed at its first line, otherwise at mainImage.
host::Finding finding(const scene::Scene& scene, const JoinedFinding& joined);

/// Returns all results as JSON.
std::string report(const ProbesRequest& request, std::span<const ProbeResult> all);

/// Returns the exit code of the command: a failure takes precedence over probes that were cut.
int exit_code(std::span<const ProbeResult> all);

// The page of `tidemark check -o`: failures first, each with its picture and the command that draws it.
// Returns text; pictures are read from the files written before.

std::string verdict_page(const ProbesRequest& request, std::span<const ProbeResult> all, double seconds);

} // namespace tidemark::cli
