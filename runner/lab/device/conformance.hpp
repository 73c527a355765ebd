// Checks ShaderToy's semantics: draws small projects and compares pixels and sounds with values worked out by
// hand (tests/cases/conformance/README.md has the format).
#pragma once

#include "base/result.hpp"
#include "render/compiled_scene.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tidemark::lab {

/// Returns the folder's subfolders, one project each, sorted by name.
std::vector<std::filesystem::path> conformance_projects(const std::filesystem::path& folder);

/// Returns the name of the rule that the project checks.
Result<std::string> convention_of(const std::filesystem::path& project);

/// Draws the project in its own size and sample type. Fails with the first pixel or sound sample that differs
/// from the rule, or if the project cannot be read or compiled.
Result<void> conforms(const std::filesystem::path& project, render::RenderOptions options = {});

} // namespace tidemark::lab
