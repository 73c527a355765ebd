// Converts a shader to double precision: the author's text with every float a double, and the functions that
// GLSL has for floats only. Text in, text out; every line keeps its number.
#pragma once

#include "base/result.hpp"
#include "glsl/double/float_hashes.hpp"
#include "text/mapped_text.hpp"

#include <string>
#include <vector>

namespace tidemark::glsl {

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
