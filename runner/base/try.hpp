// Returns an error to the caller in one macro: `const auto scene = TRY(load_scene(path));`.
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

/// The value of a Result; an error is returned from the enclosing function. It is a statement expression,
/// which GCC and clang have. On the error path, clang 14 does not destroy what the same expression has made
/// before it: put it first in its statement, `T{TRY(a), b}`, and not after anything that owns memory.
#define TRY(...)                                                                                             \
    __extension__({                                                                                          \
        auto tidemark_result = (__VA_ARGS__);                                                                \
        if (!tidemark_result)                                                                                \
            return ::tidemark::fail(std::move(tidemark_result).error());                                     \
        ::tidemark::value_of(std::move(tidemark_result));                                                    \
    })
