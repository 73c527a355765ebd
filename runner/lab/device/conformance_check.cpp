#include "base/installed.hpp"
#include "lab/device/conformance.hpp"
#include "lab/device/device_checks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tidemark::lab {

Result<DeviceAnswer> ask_conformance() {
    const auto projects = conformance_projects(conformance_folder());
    if (projects.empty())
        return DeviceAnswer{Verdict::warn, fmt::format("not asked: there are no projects in '{}'",
                                                       conformance_folder().string())};
    std::vector<std::string> others;
    for (const auto& project : projects)
        if (const auto drawn = conforms(project); !drawn)
            others.push_back(fmt::format("{}: {}", project.filename().string(), to_string(drawn.error())));
    if (!others.empty())
        return DeviceAnswer{Verdict::fail,
                            fmt::format("{} of {} projects are not as ShaderToy's rules have them: {}",
                                        others.size(), projects.size(), fmt::join(others, "; "))};
    return DeviceAnswer{
        Verdict::pass,
        fmt::format("{} projects have the pixels and sounds of ShaderToy's rules", projects.size())};
}

} // namespace tidemark::lab
