// Reads numbers from a scene's text: those defined by `#define NAME` or `const … NAME`, and plain literals.
// Also matches names against keywords.
#pragma once

#include "scene/scene.hpp"

#include <initializer_list>
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
};

/// Returns all number literals of Common and of the passes, in the order of the text.
std::vector<TextNumber> text_numbers(const scene::Scene& scene);

/// Returns whether the name contains one of the words, which are in lower case; the case of the name is
/// ignored.
bool speaks_of(std::string_view name, std::initializer_list<std::string_view> words);

} // namespace tidemark::lab
