// The check functions, by subject.
#pragma once

#include "lab/device/device_check.hpp"

namespace tidemark::lab {

// Numbers (number_checks.cpp, function_checks.cpp).
Result<DeviceAnswer> ask_special_values();
Result<DeviceAnswer> ask_arithmetic();
Result<DeviceAnswer> ask_contraction();
Result<DeviceAnswer> ask_doubles();
Result<DeviceAnswer> ask_functions();
Result<DeviceAnswer> ask_large_sines();

// Drawing (drawing_checks.cpp).
Result<DeviceAnswer> ask_read_back();
Result<DeviceAnswer> ask_read_ahead();
Result<DeviceAnswer> ask_bytes();
Result<DeviceAnswer> ask_repeatability();
Result<DeviceAnswer> ask_tiles();
Result<DeviceAnswer> ask_loops();

// Other driver features (driver_checks.cpp).
Result<DeviceAnswer> ask_program_cache();
Result<DeviceAnswer> ask_timer();
Result<DeviceAnswer> ask_reset();

// Whole projects (conformance_check.cpp).
Result<DeviceAnswer> ask_conformance();

} // namespace tidemark::lab
