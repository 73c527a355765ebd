#include "cli/check_probes.hpp"

#include "base/file.hpp"
#include "cli/console.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "cli/version.hpp"
#include "image/picture_file.hpp"
#include "lab/probe.hpp"
#include "platform/headless_context.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>

namespace tidemark::cli {
namespace fs = std::filesystem;
namespace {

using lab::Verdict;

struct Asked {
    const lab::Probe* probe;
    lab::Answer answer;
    double seconds = 0;
    fs::path picture; ///< empty: none was written
};

std::string probe_names() {
    std::string names;
    for (const lab::Probe& probe : lab::all_probes())
        names += fmt::format("{}{}", names.empty() ? "" : ", ", probe.name);
    return names;
}

Result<std::vector<const lab::Probe*>> chosen_probes(const std::vector<std::string>& names) {
    std::vector<const lab::Probe*> chosen;
    for (const std::string& name : names)
        if (std::ranges::find(lab::all_probes(), name, &lab::Probe::name) == lab::all_probes().end())
            return fail(ErrorCode::usage, fmt::format("--probe {}: there are {}", name, probe_names()));
    for (const lab::Probe& probe : lab::all_probes())
        if (names.empty() || std::ranges::find(names, probe.name) != names.end())
            chosen.push_back(&probe);
    return chosen;
}

Result<lab::Promises> promises_of(const fs::path& scene) {
    const fs::path file = file_beside(scene, "check.json");
    std::error_code ignored;
    if (!fs::exists(file, ignored))
        return lab::Promises{};
    const auto text = read_text_file(file);
    if (!text)
        return fail(text.error());
    return lab::parse_promises(*text, file.string());
}

std::string reproduction(const ProbesRequest& request, const lab::Situation& situation) {
    std::string options;
    const auto add = [&options](const char* name, const std::vector<std::string>& values) {
        for (const std::string& value : values)
            options += fmt::format("{} '{}' ", name, value);
    };
    add("--set", request.scene.sets);
    add("--define", request.scene.defines);
    add("--channel", request.scene.channels);
    return fmt::format("tidemark capture {} {}{} -o {}.exr", request.scene.path.string(), options,
                       lab::capture_options(situation), request.scene.path.stem().string());
}

Result<void> keep_picture(const fs::path& folder, Asked& asked) {
    if (folder.empty() || !asked.answer.picture)
        return {};
    if (auto made = make_folder(folder); !made)
        return made;
    asked.picture = folder / fmt::format("{}.png", asked.probe->name);
    return image::write_picture(asked.picture, *asked.answer.picture);
}

/// Asks one probe, unless the scene leaves it out and nobody named it.
Result<Asked> ask(const lab::Probe& probe, lab::ProbeBench& bench, bool by_name, bool time_left) {
    Asked asked{&probe, {Verdict::not_applicable, {}, {}, {}}, 0, {}};
    const auto skipped = bench.promises().skip.find(std::string(probe.name));
    if (!by_name && skipped != bench.promises().skip.end()) {
        asked.answer.sentence = "left out by the scene: " + skipped->second;
    } else if (!time_left) {
        asked.answer.sentence = "not asked: --budget is spent";
    } else {
        const auto start = std::chrono::steady_clock::now();
        auto answer = probe.ask(bench);
        if (!answer)
            return fail(std::move(answer.error()));
        asked.answer = *std::move(answer);
        asked.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    return asked;
}

std::string table(const ProbesRequest& request, const std::vector<Asked>& all) {
    double seconds = 0;
    for (const Asked& asked : all)
        seconds += asked.seconds;
    std::string text;
    for (const Asked& asked : all) {
        text += fmt::format("{:4}  {:10} {}", lab::to_string(asked.answer.verdict), asked.probe->name,
                            asked.answer.sentence);
        if (asked.seconds > 0)
            text += fmt::format("  [{:.0f} %]", 100 * asked.seconds / seconds);
        text += '\n';
        if (asked.answer.where)
            text += fmt::format("                 {}\n", reproduction(request, *asked.answer.where));
        if (!asked.picture.empty())
            text += fmt::format("                 {}\n", asked.picture.string());
    }
    return text + fmt::format("{:.1f} s\n", seconds);
}

std::string report(const ProbesRequest& request, const std::vector<Asked>& all) {
    nlohmann::ordered_json json = {{"tidemark", k_version}, {"scene", request.scene.path.string()}};
    json["probes"] = nlohmann::ordered_json::array();
    for (const Asked& asked : all) {
        nlohmann::ordered_json entry = {{"probe", asked.probe->name},
                                        {"verdict", lab::to_string(asked.answer.verdict)},
                                        {"found", asked.answer.sentence},
                                        {"seconds", asked.seconds}};
        if (asked.answer.where)
            entry["reproduction"] = reproduction(request, *asked.answer.where);
        if (!asked.picture.empty())
            entry["picture"] = asked.picture.string();
        json["probes"].push_back(std::move(entry));
    }
    return json.dump(2) + "\n";
}

} // namespace

Result<int> list_probes() {
    std::string text;
    for (const lab::Probe& probe : lab::all_probes())
        text += fmt::format("{:10} {}\n", probe.name, probe.about);
    return put(text).map([] { return 0; });
}

Result<int> check_probes(const ProbesRequest& request) {
    const auto probes = chosen_probes(request.probes);
    if (!probes)
        return fail(probes.error());
    if (!(request.budget > 0))
        return fail(ErrorCode::usage, "--budget: give a number of seconds above 0");
    const Interrupt interrupt;
    auto scene = load(request.scene);
    if (!scene)
        return fail(std::move(scene.error()));
    auto promises = promises_of(request.scene.path);
    if (!promises)
        return fail(std::move(promises.error()));
    const auto context = platform::HeadlessContext::create(request.device);
    if (!context)
        return fail(context.error());
    lab::ProbeBench bench(*scene, *std::move(promises));
    std::vector<Asked> all;
    {
        Progress progress("probes", probes->size());
        double seconds = 0;
        for (const lab::Probe* probe : *probes) {
            if (interrupt.requested())
                return Interrupt::k_exit_code;
            auto asked = ask(*probe, bench, !request.probes.empty(), seconds < request.budget);
            if (!asked)
                return fail(std::move(asked.error()));
            if (auto kept = keep_picture(request.output, *asked); !kept)
                return fail(std::move(kept.error()));
            seconds += asked->seconds;
            all.push_back(*std::move(asked));
            progress.advance();
        }
    }
    const bool failed =
        std::ranges::any_of(all, [](const Asked& asked) { return asked.answer.verdict == Verdict::fail; });
    return put(request.json ? report(request, all) : table(request, all)).map([failed] {
        return failed ? exit_code(ErrorCode::check_failed) : 0;
    });
}

} // namespace tidemark::cli
