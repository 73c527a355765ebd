// The functions that a watched text calls, as GLSL: one overload for each type.
#pragma once

#include "glsl/instrument/watch.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <string>
#include <string_view>

namespace tidemark::glsl {

/// Which of them are needed.
struct PreludeOptions {
    std::string prefix; ///< of every name
    bool capture = false;
    bool repair = false;
    bool nan_only = false;
    bool doubles = false; ///< the version has them
    size_t loops = 0;     ///< counters
};

/// In front of the text.
std::string watch_prelude(const PreludeOptions& options);

/// The overloads for a structure; behind its definition.
std::string structure_overloads(const PreludeOptions& options, const TreeFacts& facts, std::string_view name);

} // namespace tidemark::glsl
