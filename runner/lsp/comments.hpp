// What an author says of something, in the comment above it.
#pragma once

#include <string>
#include <string_view>

namespace tidemark::lsp {

/// The comment that ends on the line before that of `offset`, without its marks; empty where there is none.
std::string comment_above(std::string_view text, size_t offset);

/// The comment that the text begins with.
std::string leading_comment(std::string_view text);

} // namespace tidemark::lsp
