// What must be known of a text before a prologue is written for it: its entry points, what it declares
// itself, and which of the names we could provide it uses. Reads tokens; changes nothing.
#pragma once

#include "glsl/syntax/preprocess.hpp"
#include "scene/scene.hpp"
#include "text/tokens.hpp"

#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace tidemark::glsl {

/// One name declared by the author as `uniform TYPE NAME;`.
struct OwnUniform {
    std::string_view name;
    std::string_view type;
    bool same_as_site = false; ///< same type and length as the site's: either declaration will do
};

/// One `uniform …;` of the author's.
struct UniformDeclaration {
    size_t begin = 0; ///< offset in the text of its first character
    size_t end = 0;
    std::vector<OwnUniform> names;
    Activity activity = Activity::active;
    bool replaced = false; ///< ours stands for it: the same type, and needed earlier or in doubt
};

/// What the text does with a name that we could provide or must rename.
struct NameUse {
    size_t count = 0;
    size_t first = 0;       ///< where it is used first, as an index of tokens
    bool function = false;  ///< defined as a function
    bool macro = false;     ///< defined as a macro
    bool variable = false;  ///< declared as a global variable
    bool qualifier = false; ///< stands before another word, or in layout(…): used as the keyword it is

    bool defined() const { return function || macro || variable; }
};

struct Survey {
    std::unordered_map<std::string_view, NameUse> names; ///< of knobs, and those that words.hpp has
    std::vector<UniformDeclaration> uniforms;
    std::vector<size_t> entries; ///< the name of each definition of the entry point, as an index of tokens
    bool entry_is_macro = false; ///< golf: `#define mainImage(O,U) …`
    bool entry_is_plain = false; ///< the definition has the parameters that our prototype has
    bool entry_reads_colour = false;     ///< its colour is `inout`
    bool entry_takes_one = false;        ///< its only parameter is a vector
    bool entry_in_macro = false;         ///< `#define main() mainImage(out vec4 …)`
    bool sound_takes_time_alone = false; ///< `mainSound(float time)`
    std::vector<size_t> mains;           ///< the name of each `void main()` of the author's own
    bool main_is_macro = false;
    bool discards = false;       ///< or may do so
    std::string_view own_output; ///< `out vec4 NAME;`
    std::string_view own_output_type;

    /// Declares that uniform in a way that ours cannot replace.
    bool keeps_uniform(std::string_view name) const;
    bool uses(std::string_view name) const;
    bool defines(std::string_view name) const;
    /// Used, and left to us to provide.
    bool wants(std::string_view name) const { return uses(name) && !defines(name) && !keeps_uniform(name); }
};

std::string_view entry_point(scene::PassKind kind);

/// The uniforms that our own `main` reads; an author's declaration of those must stand before it.
std::span<const std::string_view> uniforms_of_wrapper(scene::PassKind kind);

/// `knobs` are names that we could provide, too.
Survey survey(const std::vector<text::Token>& tokens, const Preprocessed& preprocessed, scene::PassKind kind,
              std::span<const scene::Knob> knobs = {});

} // namespace tidemark::glsl
