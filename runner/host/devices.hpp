// OpenGL devices: the user's choice, permanent names, the order of attempts, Mesa's shader cache.
//
// The user's choice of a device, from `--device` and `--require-gpu`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::host {

struct DeviceChoice {
    std::string name = "auto";
    bool gpu_only = false; ///< fail rather than draw on the CPU
};

/// A device's name without its prefix. `es:NAME` is the device NAME with OpenGL ES.
struct DeviceName {
    std::string name;
    bool es = false;
};
DeviceName split_device_name(std::string_view name);
/// Returns the name of the same device with OpenGL ES, also for a name that has the prefix.
std::string with_es(std::string_view name);

// Permanent names of a graphics card, which other programs use too: its address on the PCI bus, its UUID,
// CUDA's number. EGL's order (device:N) is EGL's alone and changes when cards are added.

/// The kernel's folder of device files by number.
inline const std::filesystem::path k_device_numbers = "/sys/dev/char";

/// Returns `pci:0000:65:00.0` for a card's file, such as /dev/dri/renderD128; nullopt if it is not on a PCI
/// bus.
std::optional<std::string> pci_name(const std::filesystem::path& file,
                                    const std::filesystem::path& device_numbers = k_device_numbers);

/// Formats 16 bytes as `uuid:12345678-9abc-…`, like nvidia-smi and Vulkan.
std::string uuid_name(std::span<const uint8_t, 16> bytes);

// The order in which "auto" tries the places where a context may be made. Values in, names out; does not call
// EGL.

/// Surfaceless comes first, since it starts fastest. If it would draw on the CPU and there is a graphics
/// card, the card comes first: that is a vendor's driver next to Mesa, and surfaceless is only Mesa's. Then
/// the other devices, hardware before software; the default display is last. `device_is_software[n]`
/// describes "device:n".
std::vector<std::string> order_to_try(const std::vector<bool>& device_is_software,
                                      bool surfaceless_is_software);

// Turns Mesa's shader cache off if its disk is full. Mesa maps its cache files into memory, and on a full
// disk a write to one of them ends the process (SIGBUS). Must be called before a driver is loaded.

/// Disables Mesa's cache, for this process and its children, if the cache folder that the environment selects
/// has no room for the index that Mesa maps. Leaves no file there.
void do_without_full_driver_cache();

} // namespace tidemark::host
