#include "glsl/dialect.hpp"

#include <fmt/format.h>

namespace tidemark::glsl {

std::string to_string(const Dialect& dialect) {
    std::string_view version = dialect.version == Version::core_330   ? "330 core"
                               : dialect.version == Version::core_450 ? "450 core"
                                                                      : "300 es";
    std::string_view main = dialect.main == MainPlace::first  ? ""
                            : dialect.main == MainPlace::last ? ", main last"
                                                              : ", the author's own main";
    std::string_view precision = dialect.precision == Precision::single ? ""
                                 : dialect.precision == Precision::promoted
                                     ? ", in double precision"
                                     : ", in double precision, hashes too";
    return fmt::format("{}{}{}{}{}", version, main, dialect.initialise ? "" : ", nothing initialised",
                       precision, dialect.joins_overloads ? ", built-in functions overloaded" : "");
}

} // namespace tidemark::glsl
