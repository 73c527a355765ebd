// Lists devices that can have an OpenGL context. Runs in child processes: a driver that crashes or hangs when
// it starts is listed with that as its reason.

#include "base/error.hpp"
#include "cli/inspect.hpp"
#include "host/console.hpp"
#include "host/forked.hpp"
#include "host/gl_context.hpp"
#include "host/json.hpp"
#include "host/version.hpp"
#include "lab/device_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <vector>

namespace tidemark::cli {
namespace {

using platform::HeadlessDevice;

/// A driver that needs longer to start hangs.
constexpr double k_patience_seconds = 30;

std::string told(const HeadlessDevice& device, bool tried) {
    return dump({{"name", device.name},
                 {"kind", int(device.kind)},
                 {"renderer", device.renderer},
                 {"version", device.version},
                 {"reason", device.reason},
                 {"names", device.lasting_names},
                 {"tried", tried}});
}

HeadlessDevice device_of(const Json& json) {
    return {json.at("name"),     platform::DeviceKind(json.at("kind").get<int>()),
            json.at("renderer"), json.at("version"),
            json.at("reason"),   json.at("names")};
}

/// Lists devices like platform::list_headless_devices; call it before this process has a driver. Fails
/// (ErrorCode::no_context) if the listing itself crashes or hangs.
Result<std::vector<HeadlessDevice>> list_devices_apart() {
    std::vector<HeadlessDevice> found;
    for (;;) {
        std::optional<HeadlessDevice> in_hand;
        const auto run = run_forked(
            [&](const Tell& tell) {
                platform::list_headless_devices(
                    [&](const HeadlessDevice& device, bool tried) { tell(told(device, tried)); },
                    found.size());
            },
            {k_patience_seconds},
            [&](std::string_view line) {
                const Json json = parse_json(line);
                in_hand = device_of(json);
                if (json.at("tried").get<bool>())
                    found.push_back(*std::exchange(in_hand, std::nullopt));
            });
        if (!run)
            return fail(run.error());
        if (!run->timed_out && run->crash.empty())
            return found;
        const std::string what =
            run->timed_out ? fmt::format("the driver does not start within {:.0f} s", k_patience_seconds)
                           : run->crash;
        if (!in_hand)
            return fail(ErrorCode::no_context, "listing OpenGL's devices: " + what);
        in_hand->reason = what;
        found.push_back(*std::move(in_hand));
    }
}

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
    const auto run = TRY(run_forked([&](const Tell& tell) { ask_all(device, tell); }, {k_self_test_seconds},
                                    [&](std::string_view line) { verdicts.push_back(parse_json(line)); }));
    if (!run.timed_out && run.crash.empty())
        return verdicts;
    if (verdicts.size() == lab::device_checks().size()) // ended after the last answer
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
