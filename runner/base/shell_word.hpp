// Quotes and splits the arguments of a command line.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark {

/// Quotes an argument for a POSIX shell: unchanged if that is safe, else between apostrophes, with escapes
/// for characters that control a terminal.
std::string shell_word(std::string_view word);

/// Quotes several arguments, with blanks between them.
std::string shell_words(std::span<const std::string> words);

/// Splits at blanks, as in `EDITOR="code --wait"`; quotes have no meaning, and no shell is used.
std::vector<std::string> split_words(std::string_view words);

} // namespace tidemark
