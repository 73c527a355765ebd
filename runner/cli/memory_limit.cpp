#include "cli/memory_limit.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>

namespace tidemark::cli {
namespace {

constexpr uint64_t k_kibi = 1024;

/// Reads up to 4096 bytes of a system file, whose size is not known before it is read.
std::string system_file(const std::string& path) {
    std::array<char, 4096> text{};
    const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0)
        return {};
    const ssize_t count = ::read(file, text.data(), text.size());
    ::close(file);
    return {text.data(), size_t(std::max<ssize_t>(count, 0))};
}

/// Returns the container's memory limit in bytes; the largest value if there is none.
uint64_t limit_of_container() {
    for (const char* file : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
        const std::string text = system_file(file);
        uint64_t limit = 0;
        if (std::from_chars(text.data(), text.data() + text.size(), limit).ec == std::errc{} && limit > 0)
            return limit;
    }
    return std::numeric_limits<uint64_t>::max();
}

void add_descendants(pid_t process, std::vector<pid_t>& found) {
    const std::string tasks = fmt::format("/proc/{}/task", process);
    DIR* folder = ::opendir(tasks.c_str());
    if (!folder)
        return;
    while (const dirent* task = ::readdir(folder)) {
        if (task->d_name[0] == '.')
            continue;
        const std::string children = system_file(fmt::format("{}/{}/children", tasks, task->d_name));
        const char* end = children.data() + children.size();
        for (const char* at = children.data(); at < end;) {
            pid_t child = 0;
            const auto [next, error] = std::from_chars(at, end, child);
            if (error != std::errc{})
                break;
            found.push_back(child);
            add_descendants(child, found);
            at = next + 1;
        }
    }
    ::closedir(folder);
}

} // namespace

uint64_t machine_memory() {
    const long pages = ::sysconf(_SC_PHYS_PAGES);
    const long size = ::sysconf(_SC_PAGESIZE);
    const uint64_t machine = pages > 0 && size > 0 ? uint64_t(pages) * uint64_t(size) : 0;
    return std::min(machine, limit_of_container());
}

Result<uint64_t> parse_memory(std::string_view text, uint64_t machine) {
    double number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    std::string_view unit = text.substr(size_t(end - text.data()));
    double factor = 0;
    if (error == std::errc{} && std::isfinite(number)) {
        if (unit == "%")
            factor = double(machine) / 100;
        else if (unit.empty())
            factor = 1;
        else if (const size_t power = std::string_view("KMGT").find(unit.front()); power != unit.npos) {
            unit.remove_prefix(1);
            if (unit.empty() || unit == "B" || unit == "iB")
                factor = std::pow(double(k_kibi), double(power + 1));
        }
    }
    const double bytes = number * factor;
    if (!(bytes >= 1) || bytes > 1e18)
        return fail(ErrorCode::usage, fmt::format("--memory {}: give a size as in 512M, 2G or 50%", text));
    return uint64_t(bytes);
}

std::string memory_text(uint64_t bytes) {
    constexpr std::array<const char*, 5> k_units{"bytes", "KiB", "MiB", "GiB", "TiB"};
    auto number = double(bytes);
    size_t unit = 0;
    for (; number >= k_kibi && unit + 1 < k_units.size(); ++unit)
        number /= k_kibi;
    return fmt::format("{:.{}f} {}", number, number < 10 && number != std::floor(number) ? 1 : 0,
                       k_units[unit]);
}

std::vector<pid_t> descendants_of(pid_t process) {
    std::vector<pid_t> found;
    add_descendants(process, found);
    return found;
}

uint64_t memory_of(pid_t process) {
    // Pages: whole address space, resident, and resident pages shared with files.
    const std::string statm = system_file(fmt::format("/proc/{}/statm", process));
    unsigned long long all = 0, resident = 0, shared = 0;
    if (std::sscanf(statm.c_str(), "%llu %llu %llu", &all, &resident, &shared) != 3)
        return 0;
    return (resident - std::min(resident, shared)) * uint64_t(::sysconf(_SC_PAGESIZE));
}

} // namespace tidemark::cli
