// Who made the processor: drivers that draw on it round as its instructions do (rcpps).
#pragma once

#include <string>

namespace tidemark {

/// `GenuineIntel`, `AuthenticAMD`; empty where it does not say.
std::string processor_maker();

} // namespace tidemark
