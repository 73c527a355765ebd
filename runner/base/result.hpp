// Result<T>: a value or the Error that explains why there is none.
#pragma once

#include "base/error.hpp"

#include <tl/expected.hpp>

namespace tidemark {

template <class T>
using Result = tl::expected<T, Error>;

inline tl::unexpected<Error> fail(Error error) {
    return tl::unexpected<Error>(std::move(error));
}

inline tl::unexpected<Error> fail(ErrorCode code, std::string message) {
    return fail(Error{code, std::move(message), {}});
}

} // namespace tidemark
