// Finds the hashes in a text: functions and expressions that use the last bits of a float as random numbers,
// such as `fract(sin(x) * 43758.5)`. In double precision they would give other numbers and so another scene,
// so a promoted scene keeps them in floats.
#pragma once

#include "base/error.hpp"
#include "base/mapped_text.hpp"
#include "shader/token_reading.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tidemark::glsl {

enum class HashKind : unsigned char {
    sine,    ///< fract of a large multiple of a sine
    product, ///< fract of products of fracts
    bits     ///< floatBitsToUint and floatBitsToInt: a float's bits at any precision
};

std::string_view to_string(HashKind kind);

/// The tokens [begin, end), which must be evaluated in floats.
struct FloatRegion {
    size_t begin = 0;
    size_t end = 0;
    const Function* whole = nullptr; ///< a function, from its return type to its closing brace; nullptr: an
                                     ///< expression
    HashKind kind = HashKind::sine;
    /// First and last tokens of each outside part, which is evaluated in double and then converted to float.
    std::vector<std::pair<size_t, size_t>> outside{};
};

/// Returns the regions in the order of the text, without overlap.
std::vector<FloatRegion> find_float_regions(const Reading& reading);

// Converts a shader to double precision: the author's text with every float a double, and the functions that
// GLSL has for floats only. Text in, text out; every line keeps its number.

/// A place where a promoted text still computes in floats, so that its random numbers stay those of the
/// scene.
struct KeptHash {
    std::string function; ///< function or macro; empty outside of both
    SourceLocation where;
    HashKind kind = HashKind::sine;

    bool operator==(const KeptHash&) const = default;
};

struct Promoted {
    std::string functions; ///< to put before the body
    text::MappedText body;
    std::vector<KeptHash> hashes;
};

/// Promotes `body`, a whole fragment shader without #version and #extension. Uniforms become doubles and must
/// be set as such; outputs are written as floats. `hashes_too` promotes hashes like everything else. The
/// error names a construct that has no double form, with its place.
Result<Promoted> promote(text::MappedText body, bool hashes_too = false);

} // namespace tidemark::glsl
