#include "platform/device_order.hpp"

#include <fmt/format.h>

namespace tidemark::platform {

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

} // namespace tidemark::platform
