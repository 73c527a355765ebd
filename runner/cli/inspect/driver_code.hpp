// What the driver makes of a scene's passes: how large a linked program is, in bytes of the driver's own form
// and in instructions where its compiler tells them, with and without what specialising takes out of the
// text.
#pragma once

#include "base/scratch_folder.hpp"
#include "glsl/dialect.hpp"
#include "glsl/instruction_count.hpp"
#include "glsl/specialise/specialise.hpp"
#include "scene/scene.hpp"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace tidemark::cli {

struct DriverCode {
    size_t bytes = 0; ///< 0: the driver has no such form
    std::vector<glsl::InstructionCount> instructions{};
};

/// Of one pass, for each value of glsl::Specialise.
using CompiledSizes = std::array<DriverCode, 4>;

/// While it lives, the driver compiles instead of remembering: one that remembers tells no counts. To be made
/// before the process has a context.
class FreshDriverCache {
public:
    FreshDriverCache();

private:
    ScratchFolder folder_;
};

/// For each pass of the scene, nothing where it does not link. A context must be current.
std::vector<std::optional<CompiledSizes>> compiled_sizes(const scene::Scene& scene,
                                                         glsl::Precision precision);

std::string to_lines(const CompiledSizes& sizes);
nlohmann::ordered_json to_json(const CompiledSizes& sizes);

} // namespace tidemark::cli
