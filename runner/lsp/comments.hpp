// The comments that document a declaration or a file.
#pragma once

#include <string>
#include <string_view>

namespace tidemark::lsp {

/// Returns the comment that ends on the line before that of `offset`, without its marks; empty if there is
/// none.
std::string comment_above(std::string_view text, size_t offset);

/// Returns the comment at the beginning of the text.
std::string leading_comment(std::string_view text);

} // namespace tidemark::lsp
