// Writes the GLSL functions that a watched text calls: one overload per type.
#pragma once

#include "glsl/instrument/watch.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <string>
#include <string_view>

namespace tidemark::glsl {

/// The functions to write.
struct PreludeOptions {
    std::string prefix; ///< prefix of every name
    bool capture = false;
    bool repair = false;
    bool nan_only = false;
    bool doubles = false; ///< the GLSL version has doubles
    size_t loops = 0;     ///< number of loop counters
};

/// Returns the functions to put before the text.
std::string watch_prelude(const PreludeOptions& options);

/// Returns the overloads for a structure, to put after its definition.
std::string structure_overloads(const PreludeOptions& options, const TreeFacts& facts, std::string_view name);

} // namespace tidemark::glsl
