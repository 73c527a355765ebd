// ShaderToy's semantics as pixels worked out by hand: a project that is drawn, and what its rule makes of it
// (tests/cases/conformance/README.md says how one is written).
#pragma once

#include "base/result.hpp"
#include "render/compiled_scene.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace tidemark::lab {

/// The projects in a folder, each in one of its own, by name.
std::vector<std::filesystem::path> conformance_projects(const std::filesystem::path& folder);

/// The rule that the project in that folder is about.
Result<std::string> convention_of(const std::filesystem::path& project);

/// Draws it, in size and samples its own. Fails with the first pixel or sample of sound that is another one
/// than the rule's, or as reading and compiling the project do.
Result<void> conforms(const std::filesystem::path& project, render::RenderOptions options = {});

} // namespace tidemark::lab
