// Instruments a shader so that it records how near its values come to the places where GLSL leaves them
// undefined, and which branch its comparisons take. Text in, text out; the records go into a buffer of uints
// whose layout is defined here. The shader can also replace undefined values, as another GPU may, and draw a
// part of its picture: every nth pixel from a corner.
#pragma once

#include "shader/undefined_behaviour.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tidemark::glsl {

/// A target to approach: the edge of a site's domain, or one of the two results of a comparison.
struct Objective {
    size_t site = 0;
    bool second = false;   ///< for `a < b`: b - a, not a - b, must fall below 0
    bool equality = false; ///< for `a == b` or `a != b`: both sides must be equal
};

struct DomainWatch {
    std::string text;
    std::vector<DomainSite> sites;     ///< site i has the buffer's elements from i * DomainLayout::k_site
    std::vector<Objective> objectives; ///< objective i has DomainLayout::k_objective elements, after those of
                                       ///< the sites
    /// int: the site that returns `value` where it is undefined, while all others return 0 there (an index:
    /// the nearest valid one). The number after the last site: all return 0. -1: floats, quotients of floats
    /// and shifts keep the driver's value, but normalize still returns 0.
    std::string number_uniform;
    std::string value_uniform;                              ///< float: the value of that site
    std::string stride_uniform, left_uniform, down_uniform; ///< ints, in pixels of the picture
    std::string count_uniform;                              ///< int: number of objectives to follow
    std::string width_uniform; ///< int: pixels per row of the drawn part; one text serves all sizes

    size_t words() const;
};

struct DomainLayout {
    /// Times that the site was undefined, the complement of the first such pixel, the argument of largest
    /// magnitude, and the limit of valid arguments. Arguments are bits rotated left by one.
    static constexpr size_t k_site = 4;
    /// The least room that was left, as `room_of` decodes it, and the same with the pixel in its low bits.
    static constexpr size_t k_objective = 2;
    static constexpr size_t k_most_objectives = 256;
    /// Largest number of pixels in the drawn part, which are numbered row by row.
    static constexpr uint32_t k_most_pixels = 4096;
};

/// The record of a site after a draw.
struct DomainReading {
    uint32_t count = 0;    ///< how often it was undefined
    uint32_t pixel = 0;    ///< the first pixel where it was undefined
    uint32_t argument = 0; ///< bits of a float, or of an int for sites of whole numbers
    uint32_t limit = 0;    ///< for an index the last valid one; for a quotient 1: it is one of whole numbers
};
DomainReading reading_of(const DomainWatch& watch, std::span<const uint32_t> words, size_t site);

/// The room that an objective had left: 0 or less if it was reached, infinite if its site was not evaluated.
struct DomainRoom {
    float least;
    uint32_t pixel;
};
DomainRoom room_of(const DomainWatch& watch, std::span<const uint32_t> words, size_t objective);

/// Instruments `text`; `facts` are those of `text`.
DomainWatch watch_domains(const ParsedText& text, const TreeFacts& facts, DomainScope scope);

/// Returns the fault of the float function of that name for `argument`, such as "of a negative number";
/// `argument` is the recorded one.
std::string_view domain_fault(std::string_view name, float argument);

} // namespace tidemark::glsl
