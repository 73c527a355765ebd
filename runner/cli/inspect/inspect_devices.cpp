#include "cli/inspect/inspect_devices.hpp"

#include "base/try.hpp"
#include "cli/console.hpp"
#include "cli/forked.hpp"
#include "cli/inspect/device_list.hpp"
#include "cli/json_dump.hpp"
#include "cli/version.hpp"
#include "lab/device/device_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace tidemark::cli {
namespace {

using platform::HeadlessDevice;

std::string_view name_of(platform::DeviceKind kind) {
    switch (kind) {
    case platform::DeviceKind::hardware: return "hardware";
    case platform::DeviceKind::software: return "software";
    case platform::DeviceKind::unknown: return "unknown";
    }
    return "unknown";
}

Json json_of(const platform::HeadlessDevice& device) {
    Json json = {{"name", device.name}, {"kind", name_of(device.kind)}};
    if (device.reason.empty()) {
        json["renderer"] = device.renderer;
        json["version"] = device.version;
    } else {
        json["unusable"] = device.reason;
    }
    if (!device.lasting_names.empty())
        json["lasting_names"] = device.lasting_names;
    return json;
}

std::string to_line(const platform::HeadlessDevice& device) {
    if (!device.reason.empty())
        return fmt::format("{:<12} unusable: {}\n", device.name, device.reason);
    std::string text = fmt::format("{:<12} {}, {}, OpenGL {}\n", device.name, name_of(device.kind),
                                   device.renderer, device.version);
    if (!device.lasting_names.empty())
        text += fmt::format("{:<12} also called {}\n", "", fmt::join(device.lasting_names, ", "));
    return text;
}

/// All checks take some seconds on a CPU with two cores.
constexpr double k_self_test_seconds = 120;

lab::DeviceAnswer ask(const lab::DeviceCheck& check) {
    const auto answer = check.ask();
    return answer ? *answer : lab::DeviceAnswer{lab::Verdict::fail, to_string(answer.error())};
}

Json told(const lab::DeviceCheck& check, const lab::DeviceAnswer& answer) {
    return {{"check", check.name}, {"verdict", lab::to_string(answer.verdict)}, {"says", answer.sentence}};
}

void ask_all(const HeadlessDevice& device, const Tell& tell) {
    const auto context = platform::HeadlessContext::create({device.name});
    if (!context) { // it worked when the devices were listed
        tell(dump({{"check", "context"}, {"verdict", "fail"}, {"says", to_string(context.error())}}));
        return;
    }
    for (const lab::DeviceCheck& check : lab::device_checks())
        tell(dump(told(check, ask(check))));
}

/// Checks a device in a child process; a crash or a hang is a failed check.
Result<Json> verdicts_on(const HeadlessDevice& device) {
    Json verdicts = Json::array();
    const auto run = TRY(run_forked([&](const Tell& tell) { ask_all(device, tell); }, k_self_test_seconds,
                                    [&](std::string_view line) { verdicts.push_back(parse_json(line)); }));
    if (!run.timed_out && run.crash.empty())
        return verdicts;
    verdicts.push_back({{"check", std::string(lab::device_checks()[verdicts.size()].name)},
                        {"verdict", "fail"},
                        {"says", run.timed_out ? fmt::format("no answer within {:.0f} s", k_self_test_seconds)
                                               : run.crash}});
    return verdicts;
}

bool is_failure(const Json& verdict) {
    return verdict.at("verdict") == lab::to_string(lab::Verdict::fail);
}

std::string line_of(const Json& verdict) {
    return fmt::format("  {:4}  {:15}  {}\n", verdict.at("verdict").get<std::string>(),
                       verdict.at("check").get<std::string>(), verdict.at("says").get<std::string>());
}

} // namespace

Result<int> inspect_devices(bool self_test, bool as_json) {
    Json report = {{"tidemark", k_version}, {"devices", Json::array()}};
    bool failed = false;
    for (const HeadlessDevice& device : TRY(list_devices_apart())) {
        Json& entry = report["devices"].emplace_back(json_of(device));
        std::string text = to_line(device);
        if (self_test && device.reason.empty())
            entry["checks"] = TRY(verdicts_on(device));
        for (const Json& verdict : entry.value("checks", Json::array())) {
            failed |= is_failure(verdict);
            text += line_of(verdict);
        }
        if (!as_json)
            TRY(put(text));
    }
    if (as_json)
        TRY(put(dump(report, 2) + "\n"));
    return failed ? exit_code(ErrorCode::check_failed) : 0;
}

} // namespace tidemark::cli
