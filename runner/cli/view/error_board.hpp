// The error on show, with the source lines it refers to.
#pragma once

#include "base/error.hpp"
#include "live/error_field.hpp"

#include <string>
#include <vector>

namespace tidemark::cli {

class ErrorBoard {
public:
    /// Sets the error; null: there is none. Reads the files if the error differs from the last one. Returns
    /// whether it differs.
    bool show(const Error* error);
    const std::vector<live::ErrorField>& fields() const { return fields_; }

private:
    std::string text_; ///< of the error
    std::vector<live::ErrorField> fields_;
};

} // namespace tidemark::cli
