#include "base/printable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace tidemark {
namespace {

/// Returns whether a terminal obeys the character without showing it: Unicode's C1 controls, writing
/// direction, line and paragraph separators, byte order mark.
bool steers(int code) {
    return (code >= 0x7f && code < 0xa0) || code == 0x61c || code == 0x200e || code == 0x200f ||
           (code >= 0x2028 && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069) || code == 0xfeff;
}

std::string shown(std::string_view text, std::string_view kept) {
    std::string result;
    result.reserve(text.size());
    while (!text.empty()) {
        const auto [length, code] = first_character(text);
        if (code < 0 || (code < 0x20 && kept.find(text[0]) == kept.npos))
            fmt::format_to(std::back_inserter(result), "\\x{:02x}", static_cast<unsigned char>(text[0]));
        else if (steers(code)) // the same form as in JSON
            fmt::format_to(std::back_inserter(result), "\\u{:04x}", code);
        else
            result.append(text.substr(0, length));
        text.remove_prefix(length);
    }
    return result;
}

} // namespace

Character first_character(std::string_view text) {
    const auto byte = [&](size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned first = byte(0);
    if (first < 0x80)
        return {1, int(first)};
    const size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || text.size() < length)
        return {};
    int code = int(first & (0x7fu >> length));
    for (size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xc0u) != 0x80)
            return {};
        code = code << 6 | int(byte(i) & 0x3fu);
    }
    const int least = length == 2 ? 0x80 : length == 3 ? 0x800 : 0x10000;
    const bool surrogate = code >= 0xd800 && code < 0xe000;
    return code < least || code > 0x10ffff || surrogate ? Character{} : Character{length, code};
}

std::string printable(std::string_view text) {
    return shown(text, "\t\n");
}

std::string printable_line(std::string_view text) {
    return shown(text, {});
}

std::string valid_utf8(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const auto [length, code] = first_character(text);
        result.append(code < 0 ? std::string_view("\xef\xbf\xbd") : text.substr(0, length));
        text.remove_prefix(length);
    }
    return result;
}

std::string cut_text(std::string_view text, size_t most) {
    constexpr std::string_view k_rest = "...";
    if (text.size() <= most)
        return std::string(text);
    const auto continues = [](char byte) { return (static_cast<unsigned char>(byte) & 0xc0u) == 0x80; };
    size_t end = most - std::min(most, k_rest.size());
    while (end > 0 && continues(text[end]))
        --end;
    return std::string(text.substr(0, end)).append(k_rest);
}

bool is_printable_line(std::string_view text) {
    return printable_line(text) == text;
}

} // namespace tidemark
