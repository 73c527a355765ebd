#pragma once

#include <gmock/gmock.h>

namespace tidemark {

/// Matches a message that contains all these parts: places, options, files, values. The wording around them
/// is for tests/transcripts.
template <typename... Parts>
auto naming(const Parts&... parts) {
    return testing::AllOf(testing::HasSubstr(parts)...);
}

} // namespace tidemark
