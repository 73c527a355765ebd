// Joins what several probes say of one cause into one finding, and prints findings for the scene's author.

#include "cli/check_report.hpp"
#include "host/requests.hpp"
#include "shader/pass_reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <functional>
#include <sstream>
#include <string_view>
#include <utility>

namespace tidemark::cli {

using namespace host;
namespace {

using lab::Family;
using lab::Remedy;
using lab::Verdict;

/// The column in which the text of a finding begins.
constexpr int k_indent = 6;
/// The column in which the sentence of a probe begins.
constexpr int k_margin = 18;

Family family_of(const ProbeResult& result) {
    return result.answer.non_finite ? Family::numbers : result.probe->plain.family;
}

/// The cause of a NaN and its lines, from a trace.
struct Origin {
    std::string cause;
    std::vector<SourceLocation> places;
};

/// Reads the origin from a trace, or both if fixing another operation fixes the pixel.
Origin origin_of(const Json& trace) {
    Origin origin;
    for (const char* name : {"fix", "first"}) {
        if (!trace.contains(name) || !trace[name].is_object())
            continue;
        const Json& operation = trace[name];
        SourceLocation where{operation.at("file").get<std::string>(), operation.at("line").get<int>()};
        if (where.file.empty())
            continue;
        if (origin.cause.empty())
            operation.at("reason").get_to(origin.cause);
        if (std::ranges::find(origin.places, where) == origin.places.end())
            origin.places.push_back(std::move(where));
    }
    return origin;
}

/// A result in the words of the scene's author.
struct Plain {
    const ProbeResult* result;
    std::string effect, cause;
    std::vector<SourceLocation> places;
};

Plain plain_of(const ProbeResult& result) {
    const lab::Answer& answer = result.answer;
    Plain plain{&result, answer.effect, answer.cause, answer.places};
    if (answer.effect.empty()) {
        plain.effect = result.probe->plain.effect;
        plain.cause = result.probe->plain.cause;
    }
    if (!answer.non_finite)
        return plain;
    Origin origin = origin_of(result.trace_json);
    plain.places = std::move(origin.places);
    plain.cause = std::move(origin.cause);
    return plain;
}

bool share_a_line(const std::vector<SourceLocation>& a, const std::vector<SourceLocation>& b) {
    return std::ranges::any_of(
        a, [&](const SourceLocation& where) { return std::ranges::find(b, where) != b.end(); });
}

/// Returns whether both are about rounding, in other devices' sines or in a clock that runs on.
bool both_round(Family a, Family b) {
    const auto rounds = [](Family family) { return family == Family::sines || family == Family::clock; };
    return rounds(a) && rounds(b);
}

using SameCause = std::vector<Plain>;

bool belongs_to(const SameCause& group, const Plain& plain) {
    const Family family = family_of(*plain.result);
    return std::ranges::any_of(group, [&](const Plain& other) {
        const Family others = family_of(*other.result);
        if (share_a_line(plain.places, other.places))
            return (family != Family::alone && family == others) || both_round(family, others);
        return family != Family::alone && family == others && (plain.places.empty() || other.places.empty());
    });
}

std::vector<SameCause> grouped(std::span<const ProbeResult> all) {
    std::vector<SameCause> groups;
    for (const bool with_places : {true, false}) // those without may join several: the first
        for (const ProbeResult& result : all) {
            if (!is_finding(result.answer.verdict))
                continue;
            Plain plain = plain_of(result);
            if (plain.places.empty() == with_places)
                continue;
            const auto group =
                std::ranges::find_if(groups, [&](const SameCause& each) { return belongs_to(each, plain); });
            if (group == groups.end())
                groups.push_back({std::move(plain)});
            else
                group->push_back(std::move(plain));
        }
    return groups;
}

std::string fix_command(const ProbesRequest& request, bool hashes) {
    std::vector<std::string> words{"tidemark", "check", "--fix"};
    if (hashes)
        words.emplace_back("--hashes");
    words.push_back(file_word(request.scene.path));
    std::ranges::copy(option_words(request.scene), std::back_inserter(words));
    return shell_words(words);
}

/// Sets the command: the first that fixes the cause, otherwise the first that shows it.
void add_command(const ProbesRequest& request, JoinedFinding& finding) {
    const bool untraced = finding.results.front()->answer.non_finite && finding.places.empty();
    for (const Remedy wanted : {Remedy::fix_hashes, Remedy::fix})
        for (const ProbeResult* result : finding.results)
            if (result->probe->plain.remedy == wanted && finding.command.empty() && !untraced) {
                finding.remedy = wanted;
                finding.command = fix_command(request, wanted == Remedy::fix_hashes);
            }
    for (const ProbeResult* result : finding.results)
        if (finding.command.empty() && result->answer.where) {
            finding.remedy = Remedy::show;
            finding.command = reproduction(request, *result);
        }
}

JoinedFinding joined(const ProbesRequest& request, SameCause group) {
    // A difference on other GPUs is more specific than rounding in general, which `horizon` reports.
    std::ranges::stable_sort(group, std::greater(), [](const Plain& plain) {
        return std::pair(plain.result->answer.verdict, family_of(*plain.result) == Family::sines);
    });
    JoinedFinding finding{.level = group.front().result->answer.verdict};
    std::string cause = group.front().cause;
    if (group.front().places.empty()) // then one that names the line says more of the cause
        for (const Plain& plain : group)
            if (finding.places.empty() && !plain.places.empty() && !plain.cause.empty()) {
                cause = plain.cause;
                finding.places = plain.places;
            }
    for (const Plain& plain : group) {
        finding.results.push_back(plain.result);
        for (const SourceLocation& where : plain.places)
            if (std::ranges::find(finding.places, where) == finding.places.end())
                finding.places.push_back(where);
    }
    finding.message = group.front().effect + (cause.empty() ? "" : ": " + cause);
    finding.message.front() = char(std::toupper(static_cast<unsigned char>(finding.message.front())));
    add_command(request, finding);
    return finding;
}

std::string number_of(size_t count, const char* one, const char* many) {
    return fmt::format("{} {}", count, count == 1 ? one : many);
}

size_t count_verdict(std::span<const ProbeResult> all, Verdict verdict) {
    return size_t(
        std::ranges::count(all, verdict, [](const ProbeResult& result) { return result.answer.verdict; }));
}

std::string probe_names(const std::vector<const ProbeResult*>& results) {
    std::string names;
    for (const ProbeResult* result : results)
        names += fmt::format("{}{}", names.empty() ? "" : ", ", result->probe->name);
    return names;
}

std::string indented(const std::string& text, int columns) {
    std::string result;
    std::istringstream lines(text);
    for (std::string each; std::getline(lines, each);)
        result += std::string(size_t(columns), ' ') + each + '\n';
    return result;
}

std::string finding_text(const JoinedFinding& finding) {
    const std::string where = places_in_words(finding.places);
    std::string text = fmt::format("{:4}  {}\n", lab::to_string(finding.level), finding.message);
    text += indented(
        fmt::format("{}{}found by {}", where, where.empty() ? "" : ", ", probe_names(finding.results)),
        k_indent);
    if (!finding.command.empty())
        text += indented((finding.remedy == Remedy::show ? "See: " : "Try: ") + finding.command, k_indent);
    return text;
}

bool is_unanswered(const ProbeResult& result) {
    return result.answer.verdict == Verdict::not_applicable || result.answer.verdict == Verdict::cut;
}

/// Returns the probes that were cut, one line for each reason; with `all` also those that do not apply.
std::string unanswered(std::span<const ProbeResult> results, bool all) {
    struct Reason {
        const lab::Answer* answer;
        std::vector<const ProbeResult*> probes;
    };
    std::vector<Reason> reasons;
    for (const ProbeResult& result : results) {
        if (!is_unanswered(result) || (result.answer.verdict == Verdict::not_applicable && !all))
            continue;
        const auto same = std::ranges::find(reasons, result.answer.sentence,
                                            [](const Reason& reason) { return reason.answer->sentence; });
        if (same == reasons.end())
            reasons.push_back({&result.answer, {&result}});
        else
            same->probes.push_back(&result);
    }
    std::string text;
    for (const Reason& reason : reasons)
        text += fmt::format("{:4}  {:10}  {}\n", lab::to_string(reason.answer->verdict),
                            probe_names(reason.probes), reason.answer->sentence);
    return text;
}

/// Returns a probe's sentence with the origin of a NaN, the command that draws it, and its picture.
std::string row(const ProbesRequest& request, const ProbeResult& result) {
    std::string text = fmt::format("{:4}  {:10}  {}\n", lab::to_string(result.answer.verdict),
                                   result.probe->name, result.answer.sentence);
    text += indented(result.trace, k_margin) + indented(reproduction(request, result), k_margin);
    return text + (result.picture.empty() ? "" : indented(result.picture.string(), k_margin));
}

/// Returns for example `: horizon 40 %, rays 22 %`: the probes that took at least 1 % of the time, the
/// largest first.
std::string shares(std::span<const ProbeResult> all, double seconds) {
    std::vector<ProbeResult> dear(all.begin(), all.end());
    std::ranges::stable_sort(dear, std::greater(), &ProbeResult::seconds);
    std::string text;
    for (const ProbeResult& result : dear)
        if (const double share = 100 * result.seconds / seconds; share >= 1)
            text += fmt::format("{} {} {:.0f} %", text.empty() ? ":" : ",", result.probe->name, share);
    return text;
}

/// Returns what --all adds, or a hint that there is more.
std::string details(const ProbesRequest& request, std::span<const ProbeResult> results, bool all) {
    std::string text;
    if (all)
        for (const ProbeResult& result : results)
            text += is_unanswered(result) ? "" : row(request, result);
    else if (const size_t passed = count_verdict(results, Verdict::pass); passed > 0)
        text += fmt::format("pass  {}\n", number_of(passed, "probe found nothing", "probes found nothing"));
    return text + unanswered(results, all);
}

} // namespace

std::vector<JoinedFinding> joined_findings(const ProbesRequest& request, std::span<const ProbeResult> all) {
    std::vector<JoinedFinding> findings;
    for (SameCause& group : grouped(all))
        findings.push_back(joined(request, std::move(group)));
    const auto order = [](const JoinedFinding& finding) {
        return std::pair(-int(finding.level), finding.results.front()->probe);
    };
    std::ranges::stable_sort(findings, {}, order); // the probes lie in one table
    return findings;
}

std::string places_in_words(std::span<const SourceLocation> places) {
    constexpr size_t k_most = 3;
    std::string text;
    for (size_t i = 0; i < std::min(places.size(), k_most); ++i) {
        const bool same_file = i > 0 && places[i].file == places[i - 1].file;
        text +=
            fmt::format("{}{}{}", i > 0 ? ", " : "", same_file ? "" : places[i].file + ":", places[i].line);
    }
    return text + (places.size() > k_most ? fmt::format(" and {} more", places.size() - k_most) : "");
}

std::string counted(std::span<const JoinedFinding> findings) {
    const auto number = [&](Verdict level) {
        return size_t(std::ranges::count(findings, level, &JoinedFinding::level));
    };
    std::string text;
    const auto add = [&](size_t count, const char* one, const char* many) {
        if (count > 0)
            text += (text.empty() ? "" : ", ") + number_of(count, one, many);
    };
    add(number(Verdict::fail), "failure", "failures");
    add(number(Verdict::warn), "warning", "warnings");
    add(number(Verdict::note), "note", "notes");
    return text.empty() ? "nothing found" : text;
}

std::string printed(const ProbesRequest& request, std::span<const ProbeResult> results, double seconds) {
    const bool all = request.all || !request.probes.empty();
    const std::vector<JoinedFinding> findings = joined_findings(request, results);
    std::string text;
    for (const JoinedFinding& finding : findings)
        if (finding.level != Verdict::note || all)
            text += finding_text(finding);
    text += details(request, results, all);
    const size_t cut = count_verdict(results, Verdict::cut);
    text +=
        fmt::format("{}{}; {:.1f} s{}\n", counted(findings),
                    cut > 0 ? fmt::format(" so far, {} not answered", number_of(cut, "probe", "probes")) : "",
                    seconds, all ? shares(results, seconds) : "");
    const bool notes = std::ranges::find(findings, Verdict::note, &JoinedFinding::level) != findings.end();
    if (const size_t silent = count_verdict(results, Verdict::not_applicable); !all && (notes || silent > 0))
        text.insert(text.size() - 1,
                    fmt::format("; --all shows {}", notes ? "the notes and each probe" : "each probe"));
    return text;
}

Finding finding(const scene::Scene& scene, const JoinedFinding& joined) {
    std::optional<SourceLocation> where;
    if (!joined.places.empty())
        where = joined.places.front();
    for (const ProbeResult* result : joined.results) // a trace has the column too
        if (auto origin = origin_in(result->trace_json);
            origin && where && origin->file == where->file && origin->line == where->line)
            where = std::move(origin);
    if (!where)
        where = glsl::PassReading(scene, scene.image()).place_of("mainImage");
    const lab::Probe& probe = *joined.results.front()->probe;
    const Severity severity = joined.level == Verdict::fail   ? Severity::error
                              : joined.level == Verdict::warn ? Severity::warning
                                                              : Severity::note;
    return finding_of({where.value_or(SourceLocation{scene.file.string()}), severity, joined.message},
                      {std::string(probe.name), std::string(probe.about)});
}

} // namespace tidemark::cli
