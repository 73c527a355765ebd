// Numbers in a scene's text: finding them, addressing them, changing them for studies.
//
// Reads numbers from a scene's text: those defined by `#define NAME` or `const … NAME`, and plain literals.
// Also matches names against keywords.
#pragma once

#include "base/error.hpp"
#include "scene/knob.hpp"
#include "scene/scene.hpp"
#include "shader/source_edits.hpp"

#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::lab {

struct DefinedNumber {
    std::string name;
    double value;
    bool whole; ///< written without a decimal point or exponent
};

/// Returns the definitions whose whole value is one number, in the order of the text.
std::vector<DefinedNumber> defined_numbers(const scene::Scene& scene);
/// Returns only the definitions whose name contains one of `words` (lower case).
std::vector<DefinedNumber> defined_numbers(const scene::Scene& scene,
                                           std::initializer_list<std::string_view> words);

struct TextNumber {
    double value;
    bool beside_time; ///< iTime occurs in the same statement
    SourceLocation where{};
};

/// Returns all number literals of Common and of the passes, in the order of the text.
std::vector<TextNumber> text_numbers(const scene::Scene& scene);

/// Returns the places of that number in Common and the passes, only those beside iTime if there are any.
std::vector<SourceLocation> places_of_number(const scene::Scene& scene, double number);

/// Returns whether the name contains one of the words, which are in lower case; the case of the name is
/// ignored.
bool speaks_of(std::string_view name, std::initializer_list<std::string_view> words);

// Unnamed number literals of a scene's text, addressed by place: FILE:LINE:COLUMN.

/// Returns the place as FILE:LINE:COLUMN, as compilers write it.
std::string place_name(const SourceLocation& where);

/// Returns the number literal at that place, or nothing if `place` is malformed or no number starts there.
std::optional<glsl::WrittenWord> number_at(const scene::Scene& scene, std::string_view place);

/// Returns the change that replaces the number by `value`.
glsl::Cure replaced(const glsl::WrittenWord& number, const std::string& value);

// The named numbers of a scene that its user may change.

/// Returns the definitions whose value is one number, then the knobs. Of a scene that is a single file
/// (bare_file), definitions of included files are left out.
std::vector<scene::Setting> own_numbers(const scene::Scene& scene);

// Settings for a study: assigns values to a scene's knobs (uniform, #define or const, by name) and to unnamed
// numbers (by place, scene_numbers.hpp). It changes the scene in memory only.

using scene::Setting;

/// A name and all values that a study assigns to it, from the coarsest to the strictest.
struct Axis {
    std::string name;
    std::vector<std::string> values;
};

/// Parses `NAME=a,b,c`; commas inside parentheses belong to a value. Errors (ErrorCode::usage) name `option`.
Result<Axis> parse_axis(std::string_view text, std::string_view option);

/// Parses `NAME=V,NAME=V`, with the same errors.
Result<std::vector<Setting>> parse_settings(std::string_view text, std::string_view option);

/// Returns each name once, with its last value: the result of applying all in order.
std::vector<Setting> merged(const std::vector<Setting>& settings);

/// Returns `a = 1, b = 2`, or "defaults" if there are none.
std::string to_string(const std::vector<Setting>& settings);
std::string to_string(const std::vector<scene::KnobSetting>& settings);

/// Returns whether the name is a knob (`#iUniform`), whose value is not in the text.
bool is_knob(const scene::Scene& scene, std::string_view name);

/// Sets a knob, else rewrites a `#define` or `const`, else the number at a place. The error for an unknown
/// name (ErrorCode::usage) suggests the nearest name.
Result<void> apply(scene::Scene& scene, const Setting& setting);
Result<scene::Scene> with(scene::Scene scene, const std::vector<Setting>& settings);

/// Returns the current value in the form that `apply` takes; empty if the name is unknown.
std::string value_of(const scene::Scene& scene, std::string_view name);

// Applies text changes to a scene: a scene and changes in, a changed copy out. It writes no files.

/// Returns the scene with all changes applied, or nothing if a text does not contain the tokens to change or
/// two changes overlap.
std::optional<scene::Scene> changed(scene::Scene scene, std::span<const glsl::Cure> changes);

// The tokens of a scene's passes after preprocessing, used to check whether two texts compile to the same
// program. Pure; needs no driver.

/// Returns the tokens of all passes in order, without white space, comments and text that #if removes, or
/// nothing if the text cannot be preprocessed without the driver. Knob values are uniforms, so the tokens do
/// not contain them.
std::optional<std::vector<std::string>> compiled_words(const scene::Scene& scene);

} // namespace tidemark::lab
