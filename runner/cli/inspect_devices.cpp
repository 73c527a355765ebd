// Lists devices that can have an OpenGL context. Runs in child processes: a driver that crashes or hangs when
// it starts is listed with that as its reason.

#include "base/error.hpp"
#include "cli/inspect.hpp"
#include "host/console.hpp"
#include "host/forked.hpp"
#include "host/gl_context.hpp"
#include "host/json.hpp"
#include "lab/device_check.hpp"
#include "web/page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tidemark::cli {

using namespace host;
namespace {

using host::HeadlessDevice;

/// A driver that needs longer to start hangs.
constexpr double k_start_seconds = 30;

std::string told(const HeadlessDevice& device, bool tried) {
    return dump({{"name", device.name},
                 {"kind", int(device.kind)},
                 {"renderer", device.renderer},
                 {"version", device.version},
                 {"reason", device.reason},
                 {"names", device.lasting_names},
                 {"es", device.es_version},
                 {"tried", tried}});
}

HeadlessDevice device_of(const Json& json) {
    return {json.at("name"),     host::DeviceKind(json.at("kind").get<int>()),
            json.at("renderer"), json.at("version"),
            json.at("reason"),   json.at("names"),
            json.at("es")};
}

/// Describes a child process that did not end normally.
std::string why_it_ended(const ForkedResult& run) {
    return run.timed_out ? fmt::format("the driver does not start within {:.0f} s", k_start_seconds)
                         : run.crash;
}

/// Lists devices like host::list_headless_devices; call it before this process has a driver. Fails
/// (ErrorCode::no_context) if the listing itself crashes or hangs.
Result<std::vector<HeadlessDevice>> list_devices_apart() {
    std::vector<HeadlessDevice> found;
    for (;;) {
        std::optional<HeadlessDevice> in_hand;
        const auto run = run_forked(
            [&](const Tell& tell) {
                host::list_headless_devices(
                    [&](const HeadlessDevice& device, bool tried) { tell(told(device, tried)); },
                    found.size());
            },
            {k_start_seconds},
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
        const std::string what = why_it_ended(*run);
        if (!in_hand)
            return fail(ErrorCode::no_context, "listing OpenGL's devices: " + what);
        in_hand->reason = what;
        found.push_back(*std::move(in_hand));
    }
}

/// Lists Mesa's drivers, each from a process of its own.
Result<std::vector<HeadlessDevice>> list_mesa_drivers() {
    std::vector<HeadlessDevice> found;
    for (const std::string& name : host::mesa_drivers()) {
        HeadlessDevice device{name, host::DeviceKind::software, {}, {}, {}, {}, {}};
        const auto run = TRY(run_forked(
            [&](const Tell& tell) { tell(told(host::describe_mesa_driver(name), true)); }, {k_start_seconds},
            [&](std::string_view line) { device = device_of(parse_json(line)); }));
        if (run.timed_out || !run.crash.empty())
            device.reason = why_it_ended(run);
        found.push_back(std::move(device));
    }
    return found;
}

Result<std::vector<HeadlessDevice>> list_devices() {
    std::vector<HeadlessDevice> devices = TRY(list_devices_apart());
    std::ranges::move(TRY(list_mesa_drivers()), std::back_inserter(devices));
    return devices;
}

std::string_view name_of(host::DeviceKind kind) {
    switch (kind) {
    case host::DeviceKind::hardware: return "hardware";
    case host::DeviceKind::software: return "software";
    case host::DeviceKind::unknown: return "unknown";
    }
    return "unknown";
}

Json json_of(const host::HeadlessDevice& device) {
    Json json = {{"name", device.name}, {"kind", name_of(device.kind)}};
    if (device.reason.empty()) {
        json["renderer"] = device.renderer;
        json["version"] = device.version;
    } else {
        json["unusable"] = device.reason;
    }
    if (!device.es_version.empty())
        json["es_version"] = device.es_version;
    if (!device.lasting_names.empty())
        json["lasting_names"] = device.lasting_names;
    return json;
}

std::string to_line(const host::HeadlessDevice& device) {
    if (!device.reason.empty())
        return fmt::format("{:<14} unusable: {}\n", device.name, device.reason);
    std::string text =
        fmt::format("{:<14} {}, {}, OpenGL {}, {}\n", device.name, name_of(device.kind), device.renderer,
                    device.version, device.es_version.empty() ? "no OpenGL ES 3.1" : device.es_version);
    if (!device.lasting_names.empty())
        text += fmt::format("{:<14} also called {}\n", "", fmt::join(device.lasting_names, ", "));
    return text;
}

/// All checks take some seconds on a CPU with two cores, but ten times as long if it is busy.
constexpr double k_self_test_seconds = 300;

lab::DeviceAnswer ask(const lab::DeviceCheck& check) {
    const auto answer = check.ask();
    return answer ? *answer : lab::DeviceAnswer{lab::Verdict::fail, to_string(answer.error())};
}

Json told(const lab::DeviceCheck& check, const lab::DeviceAnswer& answer) {
    return {{"check", check.name}, {"verdict", lab::to_string(answer.verdict)}, {"says", answer.sentence}};
}

void ask_all(const HeadlessDevice& device, const Tell& tell) {
    const auto context = host::HeadlessContext::create({device.name});
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

Result<int> inspect_devices(const std::string& only, bool self_test, bool as_json) {
    std::vector<HeadlessDevice> devices = TRY(list_devices());
    const auto is_called = [&](const HeadlessDevice& device) {
        return device.name == only || std::ranges::count(device.lasting_names, only) > 0;
    };
    if (only != "auto") {
        std::erase_if(devices, [&](const HeadlessDevice& device) { return !is_called(device); });
        if (devices.empty())
            return fail(ErrorCode::usage,
                        fmt::format("--device {}: `tidemark inspect --devices` lists the names", only));
    }
    Json report = {{"tidemark", k_version}, {"devices", Json::array()}};
    bool failed = false;
    for (const HeadlessDevice& device : devices) {
        Json& entry = report["devices"].emplace_back(json_of(device));
        std::string text = to_line(device);
        const bool by_name = host::is_mesa_driver(device.name);
        if (self_test && device.reason.empty() && (!by_name || only != "auto"))
            entry["checks"] = TRY(verdicts_on(device));
        for (const Json& verdict : entry.value("checks", Json::array())) {
            failed |= is_failure(verdict);
            text += line_of(verdict);
        }
        if (!as_json)
            TRY(put(text));
    }
    if (only == "auto") {
        const std::vector<std::string> browsers = web::usable_browsers();
        report["browsers"] = browsers;
        if (!as_json && !browsers.empty())
            TRY(put(fmt::format("{:<14} Chromium's WebGL 2, for `compare --devices` only; also {}\n",
                                browsers[0], fmt::join(std::span(browsers).subspan(1), ", "))));
    }
    if (as_json)
        TRY(put(dump(report, 2) + "\n"));
    return failed ? exit_code(ErrorCode::check_failed) : 0;
}

} // namespace tidemark::cli
