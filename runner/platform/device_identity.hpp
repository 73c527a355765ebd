// Permanent names of a graphics card, which other programs use too: its address on the PCI bus, its UUID,
// CUDA's number. EGL's order (device:N) is EGL's alone and changes when cards are added.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace tidemark::platform {

/// The kernel's folder of device files by number.
inline const std::filesystem::path k_device_numbers = "/sys/dev/char";

/// Returns `pci:0000:65:00.0` for a card's file, such as /dev/dri/renderD128; nullopt if it is not on a PCI
/// bus.
std::optional<std::string> pci_name(const std::filesystem::path& file,
                                    const std::filesystem::path& device_numbers = k_device_numbers);

/// Formats 16 bytes as `uuid:12345678-9abc-…`, like nvidia-smi and Vulkan.
std::string uuid_name(std::span<const uint8_t, 16> bytes);

} // namespace tidemark::platform
