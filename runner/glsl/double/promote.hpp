// A shader in double precision: the author's text with every float a double, and the functions that GLSL has
// for floats only. Text in, text out; no line moves.
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
    std::string function; ///< or macro; empty outside of all
    SourceLocation where;
    HashKind kind = HashKind::sine;

    bool operator==(const KeptHash&) const = default;
};

struct Promoted {
    std::string functions; ///< goes in front of the body
    text::MappedText body;
    std::vector<KeptHash> hashes;
};

/// `body` is a whole fragment shader but for #version and #extension. Uniforms become double and are to be
/// set as such; what it writes to goes out as floats. With `hashes_too` hashes are promoted like everything
/// else. The error names the construct that has no double form, at its place.
Result<Promoted> promote(text::MappedText body, bool hashes_too = false);

} // namespace tidemark::glsl
