// The order in which "auto" tries the places where a context may be made. Values in, names out; does not call
// EGL.
#pragma once

#include <string>
#include <vector>

namespace tidemark::platform {

/// Surfaceless comes first, since it starts fastest. If it would draw on the CPU and there is a graphics
/// card, the card comes first: that is a vendor's driver next to Mesa, and surfaceless is only Mesa's. Then
/// the other devices, hardware before software; the default display is last. `device_is_software[n]`
/// describes "device:n".
std::vector<std::string> order_to_try(const std::vector<bool>& device_is_software,
                                      bool surfaceless_is_software);

} // namespace tidemark::platform
