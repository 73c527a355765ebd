#include "lsp/position.hpp"

#include "text/utf16.hpp"

#include <algorithm>

namespace tidemark::lsp {

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

} // namespace tidemark::lsp
