#include "cli/check/verdicts.hpp"

#include "base/shell_word.hpp"
#include "cli/check/trace_text.hpp"
#include "cli/output_name.hpp"
#include "cli/version.hpp"
#include "glsl/pass_reading.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <sstream>
#include <vector>

namespace tidemark::cli {
namespace {

using lab::Verdict;

/// The column in which sentences begin.
constexpr int k_margin = 18;

bool waits(const ProbeResult& asked) {
    return asked.answer.verdict == Verdict::not_applicable || asked.answer.verdict == Verdict::cut;
}

size_t count(std::span<const ProbeResult> all, Verdict verdict) {
    return size_t(
        std::ranges::count(all, verdict, [](const ProbeResult& asked) { return asked.answer.verdict; }));
}

std::string line(Verdict verdict, const std::string& probes, const std::string& sentence) {
    return fmt::format("{:4}  {:10}  {}\n", lab::to_string(verdict), probes, sentence);
}

/// Indents each line to the margin.
std::string indented(const std::string& text) {
    std::string result;
    std::istringstream lines(text);
    for (std::string each; std::getline(lines, each);)
        result += std::string(k_margin, ' ') + each + '\n';
    return result;
}

/// Returns for example `: horizon 40 %, rays 22 %`: the probes that took at least 1 % of the time, the
/// largest first.
std::string shares(std::span<const ProbeResult> all, double seconds) {
    std::vector<ProbeResult> dear(all.begin(), all.end());
    std::ranges::stable_sort(dear, std::greater(), &ProbeResult::seconds);
    std::string text;
    for (const ProbeResult& asked : dear)
        if (const double share = 100 * asked.seconds / seconds; share >= 1)
            text += fmt::format("{} {} {:.0f} %", text.empty() ? ":" : ",", asked.probe->name, share);
    return text;
}

} // namespace

bool is_finding(const lab::Answer& answer) {
    return answer.verdict == Verdict::fail || answer.verdict == Verdict::warn;
}

std::string reproduction(const ProbesRequest& request, const ProbeResult& asked) {
    if (!is_finding(asked.answer) || !asked.answer.where)
        return {};
    const std::filesystem::path& scene = request.scene.path;
    std::vector<std::string> words{"tidemark", "capture", file_word(scene)};
    std::ranges::copy(option_words(request.scene), std::back_inserter(words));
    std::ranges::copy(option_words(*asked.answer.where), std::back_inserter(words));
    words.insert(words.end(), {"-o", file_word(name_after_scene(scene, ".exr"))});
    return shell_words(words);
}

std::string counted(std::span<const ProbeResult> all) {
    std::string text;
    for (const Verdict verdict :
         {Verdict::fail, Verdict::warn, Verdict::pass, Verdict::not_applicable, Verdict::cut})
        if (const size_t number = count(all, verdict); number > 0)
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", number, lab::to_string(verdict));
    return text;
}

std::string row(const ProbesRequest& request, const ProbeResult& asked) {
    if (waits(asked))
        return {};
    std::string text = line(asked.answer.verdict, std::string(asked.probe->name), asked.answer.sentence) +
                       indented(asked.trace);
    text += indented(reproduction(request, asked));
    if (!asked.picture.empty())
        text += indented(asked.picture.string());
    return text;
}

Finding finding(const scene::Scene& scene, const ProbeResult& asked) {
    auto where = origin_in(asked.trace_json);
    if (!where)
        where = glsl::PassReading(scene, scene.image()).place_of("mainImage");
    const Severity severity = asked.answer.verdict == Verdict::fail ? Severity::error : Severity::warning;
    return finding_of({where.value_or(SourceLocation{scene.file.string()}), severity, asked.answer.sentence},
                      {std::string(asked.probe->name), std::string(asked.probe->about)});
}

std::string summary(std::span<const ProbeResult> all, double seconds) {
    struct Group {
        const lab::Answer* answer;
        std::string probes;
    };
    std::vector<Group> groups;
    for (const ProbeResult& asked : all)
        if (waits(asked)) {
            const auto same = std::ranges::find(groups, asked.answer.sentence,
                                                [](const Group& group) { return group.answer->sentence; });
            if (same == groups.end())
                groups.push_back({&asked.answer, std::string(asked.probe->name)});
            else
                same->probes += fmt::format(", {}", asked.probe->name);
        }
    std::string text;
    for (const Group& group : groups)
        text += line(group.answer->verdict, group.probes, group.answer->sentence);
    return text + fmt::format("{}; {:.1f} s{}\n", counted(all), seconds, shares(all, seconds));
}

std::string report(const ProbesRequest& request, std::span<const ProbeResult> all) {
    Json json = {{"tidemark", k_version}, {"scene", request.scene.path.string()}};
    json["probes"] = Json::array();
    for (const ProbeResult& asked : all) {
        Json entry = {{"probe", asked.probe->name},
                      {"verdict", lab::to_string(asked.answer.verdict)},
                      {"found", asked.answer.sentence},
                      {"seconds", asked.seconds}};
        if (const std::string command = reproduction(request, asked); !command.empty())
            entry["reproduction"] = command;
        if (!asked.picture.empty())
            entry["picture"] = asked.picture.string();
        if (asked.answer.non_finite) {
            entry["trace"] = asked.trace_json;
            entry["traced"] = asked.trace;
        }
        json["probes"].push_back(std::move(entry));
    }
    return dump(json, 2) + "\n";
}

int exit_code(std::span<const ProbeResult> all) {
    return count(all, Verdict::fail) > 0  ? exit_code(ErrorCode::check_failed)
           : count(all, Verdict::cut) > 0 ? exit_code(ErrorCode::timed_out)
                                          : 0;
}

} // namespace tidemark::cli
