#include "platform/device_identity.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <regex>

namespace tidemark::platform {

namespace fs = std::filesystem;

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

} // namespace tidemark::platform
