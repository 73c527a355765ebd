#include "host/devices.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <pwd.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <regex>

namespace tidemark::host {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view k_es_prefix = "es:";

}

DeviceName split_device_name(std::string_view name) {
    const bool es = name.starts_with(k_es_prefix);
    return {std::string(name.substr(es ? k_es_prefix.size() : 0)), es};
}

std::string with_es(std::string_view name) {
    return std::string(k_es_prefix) + split_device_name(name).name;
}

std::optional<std::string> pci_name(const fs::path& file, const fs::path& device_numbers) {
    struct stat facts {};
    if (stat(file.c_str(), &facts) != 0 || !S_ISCHR(facts.st_mode))
        return std::nullopt;
    const std::string number = fmt::format("{}:{}", major(facts.st_rdev), minor(facts.st_rdev));
    std::error_code failed;
    const std::string address = fs::canonical(device_numbers / number / "device", failed).filename();
    static const std::regex pattern(
        "[0-9a-f]{4,8}:[0-9a-f]{2}:[0-9a-f]{2}\\.[0-7]"); // domain:bus:slot.function
    if (failed || !std::regex_match(address, pattern))
        return std::nullopt;
    return "pci:" + address;
}

std::string uuid_name(std::span<const uint8_t, 16> bytes) {
    std::string name = "uuid:";
    for (size_t i = 0; i < bytes.size(); ++i)
        name += fmt::format("{}{:02x}", i == 4 || i == 6 || i == 8 || i == 10 ? "-" : "", bytes[i]);
    return name;
}

std::vector<std::string> order_to_try(const std::vector<bool>& device_is_software,
                                      bool surfaceless_is_software) {
    std::vector<std::string> hardware;
    std::vector<std::string> software;
    for (size_t n = 0; n < device_is_software.size(); ++n)
        (device_is_software[n] ? software : hardware).push_back(fmt::format("device:{}", n));

    std::vector<std::string> order = hardware;
    order.insert(surfaceless_is_software ? order.end() : order.begin(), "surfaceless");
    order.insert(order.end(), software.begin(), software.end());
    order.emplace_back("display");
    return order;
}

namespace {

/// Mesa's index takes 1.3 MiB; programs are in other files of that folder.
constexpr off_t k_room = off_t{4} << 20;

/// Returns the folders in which Mesa looks, in its order; Mesa's versions differ in which of the last two
/// they use.
std::vector<fs::path> folders() {
    for (const char* name : {"MESA_SHADER_CACHE_DIR", "MESA_GLSL_CACHE_DIR", "XDG_CACHE_HOME"})
        if (const char* value = std::getenv(name); value && *value)
            return {fs::path(value) / "mesa_shader_cache"};
    std::vector<fs::path> found;
    if (const char* home = std::getenv("HOME"); home && *home)
        found.push_back(fs::path(home) / ".cache/mesa_shader_cache");
    if (const passwd* user = ::getpwuid(::getuid()); user && user->pw_dir && *user->pw_dir)
        found.push_back(fs::path(user->pw_dir) / ".cache/mesa_shader_cache");
    return found;
}

/// Returns the folder, or the nearest existing one above it.
fs::path existing(fs::path folder) {
    std::error_code ignored;
    while (!fs::is_directory(folder, ignored) && folder.has_relative_path())
        folder = folder.parent_path();
    return folder.empty() ? "." : folder;
}

/// Returns whether the folder has room for Mesa's index. Tries it with a nameless file if the file system has
/// such, since quotas and limits count too.
bool has_room(const fs::path& folder) {
    const int file = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (file >= 0) {
        const int error = ::posix_fallocate(file, 0, k_room);
        ::close(file);
        if (error != EOPNOTSUPP && error != EINVAL)
            return error == 0;
    } else if (errno == ENOSPC || errno == EDQUOT) {
        return false;
    }
    struct statvfs disk {};
    return ::statvfs(folder.c_str(), &disk) != 0 ||
           uint64_t(disk.f_bavail) * disk.f_frsize >= uint64_t(k_room);
}

} // namespace

void do_without_full_driver_cache() {
    for (const fs::path& folder : folders())
        if (!has_room(existing(folder)))
            ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
}

} // namespace tidemark::host
