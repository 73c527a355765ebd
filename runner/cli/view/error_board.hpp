// The error that people see, with the lines of their files that it is about.
#pragma once

#include "base/error.hpp"
#include "live/error_field.hpp"

#include <string>
#include <vector>

namespace tidemark::cli {

class ErrorBoard {
public:
    /// Null: nothing is wrong. Reads the files when the error is another one than before, and says so.
    bool show(const Error* error);
    const std::vector<live::ErrorField>& fields() const { return fields_; }

private:
    std::string text_; ///< of the error
    std::vector<live::ErrorField> fields_;
};

} // namespace tidemark::cli
