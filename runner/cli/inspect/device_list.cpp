#include "cli/inspect/device_list.hpp"

#include "cli/forked.hpp"
#include "cli/json_dump.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <optional>

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

} // namespace

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
            k_patience_seconds,
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

} // namespace tidemark::cli
