#include "lab/device/device_check.hpp"

#include "lab/device/device_checks.hpp"

namespace tidemark::lab {

std::span<const DeviceCheck> device_checks() {
    static constexpr DeviceCheck k_checks[] = {
        {"read-back", ask_read_back},   {"read-ahead", ask_read_ahead},
        {"bytes", ask_bytes},           {"special-values", ask_special_values},
        {"arithmetic", ask_arithmetic}, {"contraction", ask_contraction},
        {"functions", ask_functions},   {"large-sines", ask_large_sines},
        {"doubles", ask_doubles},       {"repeatability", ask_repeatability},
        {"tiles", ask_tiles},           {"program-cache", ask_program_cache},
        {"reset", ask_reset},           {"loops", ask_loops},
        {"timer", ask_timer},           {"conformance", ask_conformance},
    };
    return k_checks;
}

} // namespace tidemark::lab
