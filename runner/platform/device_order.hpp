// In which order "auto" tries the places where a context may be made, from what EGL says about each.
// Values in, names out; asks EGL nothing itself.
#pragma once

#include <string>
#include <vector>

namespace tidemark::platform {

/// Surfaceless first: it starts fastest. But when it would draw on the CPU and there is a graphics card
/// (a vendor's driver beside Mesa: surfaceless is Mesa's alone), the card goes before it. Then the
/// remaining devices, hardware before software, and the default display last.
/// `device_is_software[n]` speaks of "device:n".
std::vector<std::string> order_to_try(const std::vector<bool>& device_is_software,
                                      bool surfaceless_is_software);

} // namespace tidemark::platform
