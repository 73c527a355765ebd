// The texels of a texture, and what a look-up makes of them: bounded over all coordinates of a box, by the
// filter, the wrap and the levels that GL would use (OpenGL 4.5 specification, 8.14). Weights are real
// numbers: a device has them in 8 bits or more.
#pragma once

#include "ir/evaluate.hpp"
#include "ir/interval.hpp"
#include "ir/point.hpp"

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tidemark::ir {

using TexelIndex = std::array<int64_t, 3>;

/// One level, RGBA in floats, x fastest. Over it stand smaller ones with the least and the largest of
/// 2 x 2 x 2 texels each, so that a range of any size takes a few looks.
class TexelLevel {
public:
    /// `size` 1 where there is no such axis; the layers of a cube stand in depth.
    TexelLevel(TexelIndex size, std::vector<float> rgba);

    const TexelIndex& size() const { return extrema_.front().size; }
    /// The least and the largest with an index in [first, last], which lie within the level.
    /// Where one of them is NaN or infinite, nothing is known.
    Interval range(const TexelIndex& first, const TexelIndex& last, uint32_t component) const;

private:
    struct Extrema {
        TexelIndex size{1, 1, 1};
        std::vector<float> least, largest; ///< RGBA; of the level itself they are the texels
        size_t offset(const TexelIndex& index, uint32_t component) const;
    };
    static Extrema halved(const Extrema& from);

    std::vector<Extrema> extrema_;
};

/// Which level a look-up takes that names none: what neighbouring pixels do, from which a device chooses it,
/// is not known here.
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

/// By the name of the sampler. Of one that is not there nothing is known.
using TextureSet = std::map<std::string, std::shared_ptr<const Texels>, std::less<>>;

Interval look_up(const TextureSet& textures, const Lookup& lookup, std::span<const Interval> operands,
                 UnnamedLevel unnamed = UnnamedLevel::base);

/// At one place, of the base level where none is named.
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

/// For an evaluator that lives no longer than the set.
inline Textures<Interval> textures_at_any_level(const TextureSet& textures) {
    return [&textures](const Lookup& lookup, std::span<const Interval> operands) {
        return look_up(textures, lookup, operands, UnnamedLevel::any);
    };
}

/// Likewise.
template <class Number>
Textures<Number> textures_in(const TextureSet& textures) {
    return [&textures](const Lookup& lookup, std::span<const Number> operands) {
        return look_up(textures, lookup, operands);
    };
}

} // namespace tidemark::ir
