// Extracts one project from a saved ShaderToy page or JSON, or from another program's output: a page or JSON
// in, JSON out. Makes no network requests.
#pragma once

#include "base/result.hpp"

#include <string>
#include <string_view>

namespace tidemark::scene {

/// Returns the six letters and digits of a project's address (https://www.shadertoy.com/view/XxXxXx, or one
/// with `embed` or of the API), or of an id alone; ErrorCode::usage if there are none.
Result<std::string> project_id(std::string_view address);

/// Returns JSON for `split_project`. `id` is the project to take from several; if it is empty, there must be
/// one, and JSON is returned unchanged. `file` is for messages.
Result<std::string> saved_project(std::string text, std::string_view id, const std::string& file);

} // namespace tidemark::scene
