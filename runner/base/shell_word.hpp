// Words of a command line: one that is printed for a person to run again, one that a person named.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark {

/// The word as a POSIX shell takes it for one: as it stands where that is safe, else between apostrophes,
/// what steers a terminal spelled out.
std::string shell_word(std::string_view word);

/// Several, with blanks between them.
std::string shell_words(std::span<const std::string> words);

/// What stands between blanks, as in `EDITOR="code --wait"`: nothing is quoted, and no shell looks at it.
std::vector<std::string> split_words(std::string_view words);

} // namespace tidemark
