// Names of a graphics card that stay when cards are added, and that other programs know: its place on the PCI
// bus, its UUID, CUDA's number. EGL's own order (device:N) is nobody else's.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace tidemark::platform {

/// Where the kernel says what a device file belongs to.
inline const std::filesystem::path k_device_numbers = "/sys/dev/char";

/// `pci:0000:65:00.0` of a card's file, such as /dev/dri/renderD128; nothing where it is on no PCI bus.
std::optional<std::string> pci_name(const std::filesystem::path& file,
                                    const std::filesystem::path& device_numbers = k_device_numbers);

/// `uuid:12345678-9abc-…`, as nvidia-smi and Vulkan write it, from its 16 bytes.
std::string uuid_name(std::span<const uint8_t, 16> bytes);

} // namespace tidemark::platform
