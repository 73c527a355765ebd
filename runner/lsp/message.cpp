#include "lsp/message.hpp"

#include <fmt/format.h>

#include <charconv>

namespace tidemark::lsp {
namespace {

constexpr std::string_view k_end_of_header = "\r\n\r\n";
constexpr std::string_view k_length = "content-length:";
constexpr size_t k_longest_header = 4096;
constexpr size_t k_longest_message = size_t{256} << 20; // bytes; scene texts have 16 MiB at most

bool starts_without_case(std::string_view text, std::string_view lower) {
    for (size_t i = 0; i < lower.size(); ++i)
        if (i >= text.size() ||
            (text[i] >= 'A' && text[i] <= 'Z' ? text[i] - 'A' + 'a' : text[i]) != lower[i])
            return false;
    return true;
}

/// Returns the value of `Content-Length:`; nothing where it is missing, not valid or above k_longest_message.
std::optional<size_t> length_in(std::string_view header) {
    while (!header.empty()) {
        const size_t end = std::min(header.find("\r\n"), header.size());
        std::string_view line = header.substr(0, end);
        header.remove_prefix(std::min(end + 2, header.size()));
        if (!starts_without_case(line, k_length))
            continue;
        line.remove_prefix(k_length.size());
        line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
        size_t length = 0;
        if (std::from_chars(line.data(), line.data() + line.size(), length).ec == std::errc{} &&
            length <= k_longest_message)
            return length;
    }
    return std::nullopt;
}

} // namespace

std::string framed(const Json& message) {
    const std::string text = message.dump(-1, ' ', false, Json::error_handler_t::replace);
    return fmt::format("Content-Length: {}\r\n\r\n{}", text.size(), text);
}

Json response(const Json& id, Json result) {
    return {{"jsonrpc", "2.0"}, {"id", id}, {"result", std::move(result)}};
}

Json error_response(const Json& id, ErrorNumber number, std::string_view message) {
    return {{"jsonrpc", "2.0"}, {"id", id}, {"error", {{"code", int(number)}, {"message", message}}}};
}

Json notification(std::string_view method, Json params) {
    return {{"jsonrpc", "2.0"}, {"method", method}, {"params", std::move(params)}};
}

std::optional<std::string> MessageReader::next() {
    const size_t header = bytes_.find(k_end_of_header);
    if (header == bytes_.npos) {
        broken_ |= bytes_.size() > k_longest_header;
        return std::nullopt;
    }
    const auto length = length_in(std::string_view(bytes_).substr(0, header));
    if (!length) {
        broken_ = true;
        return std::nullopt;
    }
    const size_t begin = header + k_end_of_header.size();
    if (bytes_.size() - begin < *length)
        return std::nullopt;
    std::string text = bytes_.substr(begin, *length);
    bytes_.erase(0, begin + *length);
    return text;
}

} // namespace tidemark::lsp
