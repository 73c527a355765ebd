#include "report/explore.hpp"

#include "report/html.hpp"
#include "report/parts.hpp"

namespace tidemark::report {

std::string limits_form(const std::string& error_name) {
    return filled(k_limits, {{"{{error}}", escaped(error_name)}});
}

std::string comparison_form(const std::string& note, const std::string& reference) {
    return filled(k_compare, {{"{{note}}", escaped(note)}, {"{{reference}}", reference}});
}

} // namespace tidemark::report
