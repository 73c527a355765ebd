#include "text/token_at.hpp"

#include "text/tokens.hpp"

namespace tidemark::text {

std::string_view line_of(std::string_view text, int line) {
    for (int at = 1; at < line; ++at) {
        const size_t end = text.find('\n');
        if (end == text.npos)
            return {};
        text.remove_prefix(end + 1);
    }
    return text.substr(0, text.find('\n'));
}

int end_of_token(std::string_view line, int column) {
    if (column < 1 || size_t(column) > line.size())
        return 0;
    const auto tokens = tokenize(line.substr(size_t(column) - 1));
    return tokens.empty() || tokens.front().begin != 0 ? 0 : column + int(tokens.front().text.size());
}

} // namespace tidemark::text
