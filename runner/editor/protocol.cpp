#include "editor/protocol.hpp"

#include "base/encoding.hpp"
#include "base/file.hpp"
#include "base/mapped_text.hpp"
#include "base/tokens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

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
        if (consume_number(line, length) && length <= k_longest_message)
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

Lines::Lines(std::string_view text, Encoding encoding) : text_(text), encoding_(encoding), begins_{0} {
    for (size_t end = text.find('\n'); end != text.npos; end = text.find('\n', end + 1))
        begins_.push_back(end + 1);
}

size_t Lines::begin_of(int line) const {
    return begins_[std::min(size_t(std::max(line, 1)) - 1, begins_.size() - 1)];
}

size_t Lines::end_of(int line) const {
    return std::min(text_.find('\n', begin_of(line)), text_.size());
}

Json Lines::position(size_t offset) const {
    offset = std::min(offset, text_.size());
    const auto next = std::ranges::upper_bound(begins_, offset);
    const size_t begin = *(next - 1);
    const std::string_view before = text_.substr(begin, offset - begin);
    return {{"line", size_t(next - begins_.begin()) - 1},
            {"character", encoding_ == Encoding::utf8 ? before.size() : text::utf16_length(before)}};
}

Json Lines::range(size_t begin, size_t end) const {
    return {{"start", position(begin)}, {"end", position(end)}};
}

size_t Lines::offset(const Json& position) const {
    const auto line = position.at("line").get<size_t>();
    const auto character = position.at("character").get<size_t>();
    if (line >= begins_.size())
        return text_.size();
    const size_t begin = begins_[line];
    const std::string_view whole = text_.substr(begin, end_of(int(line) + 1) - begin);
    return begin + (encoding_ == Encoding::utf8 ? std::min(character, whole.size())
                                                : text::bytes_of_utf16(whole, character));
}

namespace fs = std::filesystem;
fs::path canonical_name(const fs::path& file) {
    std::error_code error;
    fs::path path = fs::weakly_canonical(file, error);
    return error ? file.lexically_normal() : path;
}

void Documents::hold(const fs::path& file, Document document, std::string text) {
    const fs::path name = canonical_name(file);
    open_[name] = std::move(document);
    texts_[name] = text::with_plain_line_ends(std::move(text));
}

void Documents::release(const fs::path& file) {
    const fs::path name = canonical_name(file);
    open_.erase(name);
    texts_.erase(name);
}

const Document* Documents::find(const fs::path& file) const {
    const auto found = open_.find(canonical_name(file));
    return found == open_.end() ? nullptr : &found->second;
}

Result<std::string> Documents::text_of(const fs::path& file) const {
    const auto held = texts_.find(canonical_name(file));
    if (held != texts_.end())
        return held->second;
    return read_text_file(file).map(text::with_plain_line_ends);
}

std::string Documents::uri_of(const fs::path& file) const {
    const Document* document = find(file);
    return document ? document->uri : uri_reference(canonical_name(file));
}

} // namespace tidemark::lsp
