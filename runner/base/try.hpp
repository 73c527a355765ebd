// Handing an error on, in one word: `const auto scene = TRY(load_scene(path));`.
#pragma once

#include "base/result.hpp"

#include <type_traits>
#include <utility>

namespace tidemark {

template <class T>
T value_of(Result<T>&& result) {
    if constexpr (!std::is_void_v<T>)
        return *std::move(result);
}

} // namespace tidemark

/// The value of a Result; where it is an error, the function around returns that. A statement expression,
/// which GCC and clang have. clang 14 does not destroy what the same expression has made by then: it stands
/// first in its statement, `T{TRY(a), b}`, and not behind anything that owns memory.
#define TRY(...)                                                                                             \
    __extension__({                                                                                          \
        auto tidemark_result = (__VA_ARGS__);                                                                \
        if (!tidemark_result)                                                                                \
            return ::tidemark::fail(std::move(tidemark_result).error());                                     \
        ::tidemark::value_of(std::move(tidemark_result));                                                    \
    })
