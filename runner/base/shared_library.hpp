// Loads system libraries that only some runs need. They stay loaded until the process ends. The build needs
// only their headers.
#pragma once

#include "base/result.hpp"

#include <string>
#include <string_view>

namespace tidemark {

class SharedLibrary {
public:
    /// `file` is the loader's name for it: `libasound.so.2`.
    explicit SharedLibrary(const char* file);

    template <class Function>
    SharedLibrary& find(const char* name, Function*& function) {
        function = reinterpret_cast<Function*>(address_of(name));
        return *this;
    }

    /// Checks that the library and all functions were found; otherwise ErrorCode::load says what to install.
    /// `what` describes the library: `libsndfile, which reads sound`.
    Result<void> complete(std::string_view what, std::string_view package) const;

private:
    void* address_of(const char* name);

    void* handle_;
    std::string missing_{}; ///< the loader's message about the first missing thing
};

} // namespace tidemark
