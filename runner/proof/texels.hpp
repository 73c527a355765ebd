// The texels of a texture, and the result of look-ups in it: bounds over a box of coordinates, by the filter,
// the wrap and the levels that GL uses (OpenGL 4.5 specification, 8.14). Filter weights are real numbers; a
// device has them in 8 bits or more.
#pragma once

#include "proof/evaluate.hpp"
#include "proof/interval.hpp"
#include "proof/point.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tidemark::proof {

using TexelIndex = std::array<int64_t, 3>;

/// One level, RGBA in floats, x fastest. It keeps smaller levels with the minimum and maximum of 2 x 2 x 2
/// texels each, so a range of any size takes a few reads.
class TexelLevel {
public:
    /// A missing axis has size 1; the layers of a cube are stacked in depth.
    TexelLevel(TexelIndex size, std::vector<float> rgba);

    const TexelIndex& size() const { return extrema_.front().size; }
    /// Returns the least and the largest texel with an index in [first, last], which must lie within the
    /// level; unbounded if one of the texels read is NaN or infinite.
    Interval range(const TexelIndex& first, const TexelIndex& last, uint32_t component) const;

private:
    struct Extrema {
        TexelIndex size{1, 1, 1};
        /// RGBA; at full size `least` holds the texels and `largest` is empty
        std::vector<float> least, largest;
        size_t offset(const TexelIndex& index, uint32_t component) const;
    };
    static Extrema halved(const Extrema& from);

    std::vector<Extrema> extrema_;
};

/// Level of a look-up that names none. A device chooses it by the neighbouring pixels, which are not known
/// here, so it is the base level or may be any.
enum class UnnamedLevel { base, any };

struct Texels {
    enum class Kind { plane, cube, volume } kind = Kind::plane;
    enum class Wrap { repeat, clamp, mirror } wrap = Wrap::repeat;
    enum class Mipmaps { none, nearest, linear } mipmaps = Mipmaps::none;
    bool magnify_linear = true;
    bool minify_linear = true;
    std::vector<TexelLevel> levels;

    Interval look_up(const Lookup& lookup, std::span<const Interval> operands,
                     UnnamedLevel unnamed = UnnamedLevel::base) const;
    bool chooses_level(const Lookup& lookup) const {
        return mipmaps != Mipmaps::none && lookup.form == Lookup::Form::sample && !lookup.has_level &&
               !lookup.has_gradients;
    }

private:
    const TexelLevel* level_at(std::span<const Interval> number) const;
    Interval fetched(const Lookup& lookup, std::span<const Interval> operands) const;
    Interval sampled(const Lookup& lookup, std::span<const Interval> operands, UnnamedLevel unnamed) const;
    template <class AtLevel>
    Interval between_levels(const Interval& level, AtLevel at) const;
    Interval filtered(const TexelLevel& level, const Lookup& lookup, std::span<const Interval> operands,
                      bool linear) const;
};

/// Textures by the name of the sampler. Look-ups in a missing texture are unbounded.
using TextureSet = std::map<std::string, std::shared_ptr<const Texels>, std::less<>>;

Interval look_up(const TextureSet& textures, const Lookup& lookup, std::span<const Interval> operands,
                 UnnamedLevel unnamed = UnnamedLevel::base);

/// Looks up a single place, in the base level if none is named.
template <class Real>
Point<Real> look_up(const TextureSet& textures, const Lookup& lookup, std::span<const Point<Real>> operands) {
    std::vector<Interval> places;
    for (const Point<Real>& each : operands) {
        const bool whole = lookup.form == Lookup::Form::fetch || lookup.form == Lookup::Form::size;
        const double place = whole ? double(int32_t(each.bits)) : double(each.real);
        places.push_back(std::isfinite(place) ? Interval{place, place} : everything());
    }
    const Interval found = look_up(textures, lookup, places);
    if (lookup.form == Lookup::Form::size)
        return {0, uint32_t(int64_t(found.low))};
    return {Real(found.low + (found.high - found.low) / 2), 0};
}

/// The result refers to `textures`, which must outlive it.
inline Textures<Interval> textures_at_any_level(const TextureSet& textures) {
    return [&textures](const Lookup& lookup, std::span<const Interval> operands) {
        return look_up(textures, lookup, operands, UnnamedLevel::any);
    };
}

/// The result refers to `textures`, which must outlive it.
template <class Number>
Textures<Number> textures_in(const TextureSet& textures) {
    return [&textures](const Lookup& lookup, std::span<const Number> operands) {
        return look_up(textures, lookup, operands);
    };
}

} // namespace tidemark::proof
