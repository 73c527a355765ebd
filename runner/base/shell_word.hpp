// Words of a command line that is printed for a person to run again.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace tidemark {

/// The word as a POSIX shell takes it for one: as it stands where that is safe, else between apostrophes,
/// what steers a terminal spelled out.
std::string shell_word(std::string_view word);

/// Several, with blanks between them.
std::string shell_words(std::span<const std::string> words);

} // namespace tidemark
