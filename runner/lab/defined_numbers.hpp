// The numbers that a scene's text defines by name, `#define NAME` and `const … NAME`, what names speak of,
// and the numbers that simply stand there.
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
    bool whole; ///< written without a point
};

/// In the text's order.
std::vector<DefinedNumber> defined_numbers(const scene::Scene& scene);
/// Those whose name holds one of `words`.
std::vector<DefinedNumber> defined_numbers(const scene::Scene& scene,
                                           std::initializer_list<std::string_view> words);

struct TextNumber {
    double value;
    bool beside_time; ///< in one statement with iTime
};

/// All that stand in the texts of the passes, in their order.
std::vector<TextNumber> text_numbers(const scene::Scene& scene);

/// Whether the name holds one of the words, which are in lower case, in any case.
bool speaks_of(std::string_view name, std::initializer_list<std::string_view> words);

} // namespace tidemark::lab
