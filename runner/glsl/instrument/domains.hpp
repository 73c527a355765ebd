// A shader that watches how near its values come to where GLSL leaves them undefined, and which way its
// comparisons go. Text in, text out; what it sees goes into a buffer of words whose layout stands here. It
// can be made to take another value for what such a call gives, as another GPU may, and to draw a part of its
// picture: every so many pixels from a corner on.
#pragma once

#include "glsl/analysis/domain_sites.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tidemark::glsl {

/// One thing to come near to: the edge of a site's domain, or one of the two ways of a comparison.
struct Objective {
    size_t site = 0;
    bool second = false;   ///< of a comparison `a < b`: that b - a, not a - b, gets below 0
    bool equality = false; ///< `a == b` or `a != b`: that they are the same
};

struct DomainWatch {
    std::string text;
    std::vector<DomainSite> sites;     ///< number i has the words from i * DomainLayout::k_site
    std::vector<Objective> objectives; ///< number i has DomainLayout::k_objective words behind those
    /// int: the site that gives another value where it is undefined, while all others give 0 there (an index:
    /// the nearest that there is); one beyond the last: all give 0; -1: all give what the driver makes of it.
    std::string number_uniform;
    std::string value_uniform;                              ///< float: that value
    std::string stride_uniform, left_uniform, down_uniform; ///< ints: pixels of the picture
    std::string count_uniform;                              ///< int: the objectives to follow
    std::string width_uniform; ///< int: pixels in a row of what is drawn; one text serves all sizes

    size_t words() const;
};

struct DomainLayout {
    /// How often it was undefined, the complement of the first pixel that saw it, its argument farthest from
    /// zero, and the largest that it may have been. Arguments are rotated bits (argument_of).
    static constexpr size_t k_site = 4;
    /// The least room that was left, as `room_of` reads it, and the same with the pixel in its low bits.
    static constexpr size_t k_objective = 2;
    static constexpr size_t k_most_objectives = 256;
    /// Pixels are numbered within what is drawn, row by row: no more of them.
    static constexpr uint32_t k_most_pixels = 4096;
};

/// What is known of a site behind a draw.
struct DomainReading {
    uint32_t count = 0;    ///< how often it was undefined
    uint32_t pixel = 0;    ///< the first that saw it
    uint32_t argument = 0; ///< bits: a float, or of whole sites an int
    uint32_t limit = 0;    ///< of an index: the last one there is; of a quotient 1: of whole numbers
};
DomainReading reading_of(const DomainWatch& watch, std::span<const uint32_t> words, size_t site);

/// The room that an objective had left: not above 0 where it was reached. Infinite: it was not come to.
struct DomainRoom {
    float least;
    uint32_t pixel;
};
DomainRoom room_of(const DomainWatch& watch, std::span<const uint32_t> words, size_t objective);

/// `facts` are the text's own.
DomainWatch watch_domains(const ParsedText& text, const TreeFacts& facts, DomainScope scope);

/// "of a negative number": what is wrong where a float function of that name is undefined; `argument` is the
/// argument that was written down.
std::string_view domain_fault(std::string_view name, float argument);

} // namespace tidemark::glsl
