#include "glsl/syntax/number.hpp"

#include <charconv>

namespace tidemark::glsl {

std::optional<long> whole_number(std::string_view digits) {
    int base = 10;
    if (digits.starts_with("0x") || digits.starts_with("0X")) {
        base = 16;
        digits.remove_prefix(2);
    } else if (digits.size() > 1 && digits[0] == '0') {
        base = 8;
    }
    long number = 0;
    const char* const end = digits.data() + digits.size();
    const auto read = std::from_chars(digits.data(), end, number, base);
    return read.ec == std::errc{} && read.ptr == end ? std::optional(number) : std::nullopt;
}

std::optional<double> number(std::string_view word) {
    if (word.starts_with("0x") || word.starts_with("0X"))
        return std::nullopt;
    while (!word.empty() && std::string_view("uUfF").find(word.back()) != std::string_view::npos)
        word.remove_suffix(1);
    double value = 0;
    const auto read = std::from_chars(word.data(), word.data() + word.size(), value);
    if (read.ec != std::errc{} || read.ptr != word.data() + word.size())
        return std::nullopt;
    return value;
}

std::string as_float(std::string_view digits) {
    const bool whole = digits.find_first_of(".e") == digits.npos;
    return std::string(digits) + (whole ? ".0" : "");
}

} // namespace tidemark::glsl
