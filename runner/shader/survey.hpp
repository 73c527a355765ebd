// Collects what the prologue depends on: the text's entry points, its own declarations, and its uses of names
// that Tidemark can provide. Reads tokens; changes nothing.
#pragma once

#include "base/tokens.hpp"
#include "scene/scene.hpp"
#include "shader/token_reading.hpp"

#include <optional>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace tidemark::glsl {

/// One name declared by the author as `uniform TYPE NAME;`.
struct OwnUniform {
    std::string_view name;
    std::string_view type;
    bool same_as_site = false; ///< same type and length as ShaderToy's, so either declaration works
};

/// One `uniform …;` of the author's.
struct UniformDeclaration {
    size_t begin = 0; ///< offset in the text of its first character
    size_t end = 0;
    std::vector<OwnUniform> names;
    Activity activity = Activity::active;
    bool replaced = false; ///< removed in favour of Tidemark's: the same type, and needed earlier or in doubt
};

/// How the text uses a name that Tidemark can provide or must rename.
struct NameUse {
    size_t count = 0;
    size_t first = 0;       ///< token index of the first use
    bool function = false;  ///< defined as a function
    bool macro = false;     ///< defined as a macro
    bool variable = false;  ///< declared as a global variable
    bool qualifier = false; ///< precedes another identifier, or is in layout(…): used as a keyword

    bool defined() const { return function || macro || variable; }
};

struct Survey {
    /// knobs, and the fixed names that survey() looks for
    std::unordered_map<std::string_view, NameUse> names;
    std::vector<UniformDeclaration> uniforms;
    std::vector<size_t> entries;         ///< the name's token index in each definition of the entry point
    bool entry_is_macro = false;         ///< common in code golf: `#define mainImage(O,U) …`
    bool entry_is_plain = false;         ///< the definition has the parameters of Tidemark's prototype
    bool entry_reads_colour = false;     ///< its colour parameter is `inout`
    bool entry_takes_one = false;        ///< its only parameter is a vector
    bool entry_in_macro = false;         ///< `#define main() mainImage(out vec4 …)`
    bool sound_takes_time_alone = false; ///< `mainSound(float time)`
    std::vector<size_t> mains;           ///< the name's token index in each `void main()` of the author
    bool main_is_macro = false;
    bool discards = false;       ///< may discard pixels
    std::string_view own_output; ///< `out vec4 NAME;`
    std::string_view own_output_type;

    /// Returns whether the text declares that uniform in a way that Tidemark cannot replace.
    bool keeps_uniform(std::string_view name) const;
    bool uses(std::string_view name) const;
    bool defines(std::string_view name) const;
    /// Returns whether the text uses the name and Tidemark must provide it.
    bool wants(std::string_view name) const { return uses(name) && !defines(name) && !keeps_uniform(name); }
};

std::string_view entry_point(scene::PassKind kind);

/// Returns the uniforms that Tidemark's `main` reads; an author's declaration of those must precede it.
std::span<const std::string_view> uniforms_of_wrapper(scene::PassKind kind);

/// Surveys a text. The names of `knobs` can be provided, too.
Survey survey(const std::vector<text::Token>& tokens, const Preprocessed& preprocessed, scene::PassKind kind,
              std::span<const scene::Knob> knobs = {});

// `mainHit`, the entry point with which a scene reports the hits of its rays to studies and checks:
//
//     void mainHit(out vec4 hit, in vec2 fragCoord)
//
// hit.x is the distance along the ray, or -1 for a miss; hit.y counts evaluations of the field; hit.z is the
// field's last value; hit.w is the sum of the flags below. TIDEMARK_HIT is defined as 1 in this pass.

enum HitFlag {
    k_hit_exhausted = 1,      ///< the maximum number of steps was reached
    k_hit_negative = 2,       ///< the field was negative at a sample after the first: a step was too long
    k_hit_started_inside = 4, ///< the field was negative at the first sample
};

inline constexpr std::string_view k_hit_macro = "TIDEMARK_HIT";

/// Returns the scene with mainHit as the entry point of its Image pass; nothing if the text does not mention
/// it.
std::optional<scene::Scene> hit_scene(const scene::Scene& scene);

} // namespace tidemark::glsl
