// The size of a scene's compiled passes, in bytes of the driver's own program format and in instructions if
// its compiler reports them, for each level of specialisation.
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
    size_t bytes = 0; ///< 0: the driver has no program binaries
    std::vector<glsl::InstructionCount> instructions{};
};

/// The sizes of one pass, for each value of glsl::Specialise.
using CompiledSizes = std::array<DriverCode, 4>;

/// Gives the driver an empty shader cache, so that it compiles: from its cache it would report no counts.
/// Construct it before the process has a context.
class FreshDriverCache {
public:
    FreshDriverCache();

private:
    ScratchFolder folder_;
};

/// Returns the sizes of each pass of the scene; nothing for a pass that does not link. A context must be
/// current.
std::vector<std::optional<CompiledSizes>> compiled_sizes(const scene::Scene& scene,
                                                         glsl::Precision precision);

std::string to_lines(const CompiledSizes& sizes);
nlohmann::ordered_json to_json(const CompiledSizes& sizes);

} // namespace tidemark::cli
