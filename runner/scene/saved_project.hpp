// One project out of what a person saved of ShaderToy, or what a program of theirs printed: a page or JSON
// in, JSON out. No network is asked.
#pragma once

#include "base/result.hpp"

#include <string>
#include <string_view>

namespace tidemark::scene {

/// The six letters and digits of a project's address (https://www.shadertoy.com/view/XxXxXx, also of `embed`
/// or of the API), or these alone; ErrorCode::usage where there are none.
Result<std::string> project_id(std::string_view address);

/// JSON for `split_project`. `id`: the project to take where there are several; empty: there is one, and JSON
/// stays as it is. `file` is for the messages.
Result<std::string> saved_project(std::string text, std::string_view id, const std::string& file);

} // namespace tidemark::scene
