// Positions in the protocol's form: lines from 0, characters in the encoding that was agreed on.
#pragma once

#include "lsp/message.hpp"

#include <string_view>
#include <vector>

namespace tidemark::lsp {

enum class Encoding { utf8, utf16 };

/// The line starts of a text, for any number of conversions. The text must outlive it.
class Lines {
public:
    Lines(std::string_view text, Encoding encoding);

    /// Returns the position of an offset, which is clamped to the text.
    Json position(size_t offset) const;
    Json range(size_t begin, size_t end) const;
    /// Returns the offset of a position, clamped to the text.
    size_t offset(const Json& position) const;
    /// Return the offsets where a line (from 1) begins and where it ends, without its line end.
    size_t begin_of(int line) const;
    size_t end_of(int line) const;

private:
    std::string_view text_;
    Encoding encoding_;
    std::vector<size_t> begins_;
};

} // namespace tidemark::lsp
