#include "base/encoding.hpp"

#include <fmt/format.h>
#include <sha2.h>
#include <sys/types.h> // libmd's header uses its types without including it

#include <algorithm>
#include <charconv>
#include <cstdint>
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
        if (!continues_character(text[i]))
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

size_t begin_of_character(std::string_view text, size_t at) {
    while (at > 0 && at < text.size() && continues_character(text[at]))
        --at;
    return at;
}

std::string cut_text(std::string_view text, size_t most) {
    constexpr std::string_view k_rest = "...";
    if (text.size() <= most)
        return std::string(text);
    const size_t end = begin_of_character(text, most - std::min(most, k_rest.size()));
    return std::string(text.substr(0, end)).append(k_rest);
}

bool is_printable_line(std::string_view text) {
    return printable_line(text) == text;
}

namespace {

/// Quotes as `$'…'` (bash, zsh, POSIX.1-2024), with control characters as escapes: octal, of which a shell
/// reads at most three digits.
std::string spelled_out(std::string_view word) {
    std::string quoted = "$'";
    while (!word.empty()) {
        const size_t length = first_character(word).length;
        const std::string_view character = word.substr(0, length);
        word.remove_prefix(length);
        if (character == "'" || character == "\\")
            quoted += '\\';
        if (is_printable_line(character))
            quoted += character;
        else
            for (const char byte : character)
                quoted += fmt::format("\\{:03o}", static_cast<unsigned char>(byte));
    }
    return quoted + "'";
}

} // namespace

std::string shell_word(std::string_view word) {
    constexpr std::string_view k_safe =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+./:,=@%";
    if (!word.empty() && word.find_first_not_of(k_safe) == word.npos)
        return std::string(word);
    if (!is_printable_line(word))
        return spelled_out(word);
    std::string quoted = "'";
    for (const char c : word)
        quoted += c == '\'' ? "'\\''" : std::string(1, c);
    return quoted + "'";
}

std::string shell_words(std::span<const std::string> words) {
    std::string line;
    for (const std::string& word : words)
        line.append(line.empty() ? "" : " ").append(shell_word(word));
    return line;
}

std::vector<std::string> split_words(std::string_view words) {
    std::vector<std::string> found;
    while (true) {
        words.remove_prefix(std::min(words.find_first_not_of(' '), words.size()));
        if (words.empty())
            return found;
        found.emplace_back(words.substr(0, words.find(' ')));
        words.remove_prefix(found.back().size());
    }
}

namespace {

/// Returns whether a character needs no escape: RFC 3986's unreserved characters and the slash.
bool stands_for_itself(unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '.' || c == '_' || c == '~' || c == '/';
}

std::optional<std::string> without_escapes(std::string_view text) {
    std::string plain;
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            plain += text[i];
            continue;
        }
        unsigned byte = 0;
        const char* const digits = text.data() + i + 1;
        if (i + 2 >= text.size() || std::from_chars(digits, digits + 2, byte, 16).ptr != digits + 2 ||
            byte == 0)
            return std::nullopt;
        plain += char(byte);
        i += 2;
    }
    return plain;
}

} // namespace

std::string uri_reference(const std::filesystem::path& path) {
    std::string uri = path.is_absolute() ? "file://" : "";
    for (const char c : path.native())
        uri += stands_for_itself(static_cast<unsigned char>(c))
                   ? std::string(1, c)
                   : fmt::format("%{:02X}", static_cast<unsigned char>(c));
    return uri;
}

std::optional<std::filesystem::path> path_of_uri(std::string_view uri) {
    constexpr std::string_view k_scheme = "file://";
    if (!uri.starts_with(k_scheme))
        return std::nullopt;
    uri.remove_prefix(k_scheme.size());
    if (uri.starts_with("localhost/"))
        uri.remove_prefix(std::string_view("localhost").size());
    if (!uri.starts_with('/') || uri.find('\0') != uri.npos)
        return std::nullopt;
    const auto plain = without_escapes(uri);
    return plain ? std::optional(std::filesystem::path(*plain).lexically_normal()) : std::nullopt;
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view k_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t group = 0;
        const size_t count = bytes.size() - i < 3 ? bytes.size() - i : 3;
        for (size_t k = 0; k < 3; ++k)
            group = group << 8 | (k < count ? uint32_t(static_cast<unsigned char>(bytes[i + k])) : 0U);
        for (size_t k = 0; k < 4; ++k)
            text += k <= count ? k_digits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string float_literal(std::string_view digits) {
    const bool whole = digits.find_first_of(".e") == digits.npos;
    return std::string(digits) + (whole ? ".0" : "");
}

struct Sha256::State {
    SHA2_CTX context;
};

Sha256::Sha256() : state_(std::make_unique<State>()) {
    SHA256Init(&state_->context);
}

Sha256::~Sha256() = default;

void Sha256::add(std::span<const std::byte> bytes) {
    SHA256Update(&state_->context, reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
}

std::string Sha256::digits() {
    char digits[SHA256_DIGEST_STRING_LENGTH];
    SHA256End(&state_->context, digits);
    return digits;
}

std::string sha256(std::span<const std::byte> bytes) {
    Sha256 hash;
    hash.add(bytes);
    return hash.digits();
}

} // namespace tidemark
