// Libraries of the system that only some runs need: loaded by the first that asks, and there until the
// process ends. Their headers alone are compiled in.
#pragma once

#include "base/result.hpp"

#include <string>
#include <string_view>

namespace tidemark {

class SharedLibrary {
public:
    /// `file` as the loader knows it: `libasound.so.2`.
    explicit SharedLibrary(const char* file);

    template <class Function>
    SharedLibrary& find(const char* name, Function*& function) {
        function = reinterpret_cast<Function*>(address_of(name));
        return *this;
    }

    /// Whether it is there and every function was found; ErrorCode::load says what to install else. `what` is
    /// the library for people: `libsndfile, which reads sound`.
    Result<void> complete(std::string_view what, std::string_view package) const;

private:
    void* address_of(const char* name);

    void* handle_;
    std::string missing_{}; ///< the loader's words for the first thing that is
};

} // namespace tidemark
