// Names the processor's maker: software drivers round as its instructions do (rcpps).
#pragma once

#include <string>

namespace tidemark {

/// Returns `GenuineIntel` or `AuthenticAMD`, for example; empty if the processor has no such instruction.
std::string processor_maker();

} // namespace tidemark
