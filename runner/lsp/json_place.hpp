// Finds the place in the text of a project's JSON at which a line of a pass's code stands. Other places in
// JSON are not its business.
#pragma once

#include <optional>
#include <string_view>
#include <utility>

namespace tidemark::lsp {

/// Returns the offsets of a line's first byte and of its end in `json`, where the code is one string with
/// escapes. `pass` is a name by scene::pass_names, `line` counts from 1. None if the JSON has no such pass or
/// line.
std::optional<std::pair<size_t, size_t>> find_code_line(std::string_view json, std::string_view pass,
                                                        int line);

} // namespace tidemark::lsp
