// Places in a text as the protocol has them: lines from 0, characters in the encoding that was agreed on.
#pragma once

#include "lsp/message.hpp"

#include <string_view>
#include <vector>

namespace tidemark::lsp {

enum class Encoding { utf8, utf16 };

/// A text cut into its lines once, for any number of places in it, which must live as long.
class Lines {
public:
    Lines(std::string_view text, Encoding encoding);

    /// Of an offset; the end of the text for one behind it.
    Json position(size_t offset) const;
    Json range(size_t begin, size_t end) const;
    /// The nearest place that there is.
    size_t offset(const Json& position) const;
    /// Where a line, from 1, begins, and where its last character ends.
    size_t begin_of(int line) const;
    size_t end_of(int line) const;

private:
    std::string_view text_;
    Encoding encoding_;
    std::vector<size_t> begins_;
};

} // namespace tidemark::lsp
