#include "proof/texels.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace tidemark::proof {
namespace {

constexpr uint32_t k_components = 4;
/// Ranges of at most this many texels along each axis are read at full size.
constexpr int64_t k_few = 4;
/// Linear filtering over at most this many cells along each axis is bounded cell by cell.
constexpr int64_t k_few_cells = 3;
/// Limit of an index: larger coordinates may be anywhere.
constexpr double k_largest_index = 1e9;

constexpr float k_infinite = std::numeric_limits<float>::infinity();

/// Returns the index in a texture of `size` for an index that may lie beyond its edges.
int64_t wrapped(int64_t index, int64_t size, Texels::Wrap wrap) {
    const auto rest = [](int64_t a, int64_t b) { return ((a % b) + b) % b; };
    switch (wrap) {
    case Texels::Wrap::repeat: return rest(index, size);
    case Texels::Wrap::clamp: return std::clamp<int64_t>(index, 0, size - 1);
    case Texels::Wrap::mirror: {
        const int64_t at = rest(index, 2 * size);
        return at < size ? at : 2 * size - 1 - at;
    }
    }
    return 0;
}

using Span = std::pair<int64_t, int64_t>;

/// Returns the indices within the texture for those from first to last, as one or two spans.
std::vector<Span> wrapped_spans(int64_t first, int64_t last, int64_t size, Texels::Wrap wrap) {
    if (wrap == Texels::Wrap::clamp)
        return {{wrapped(first, size, wrap), wrapped(last, size, wrap)}};
    const int64_t begin = wrapped(first, size, wrap), end = wrapped(last, size, wrap);
    if (last - first >= size - 1)
        return {{0, size - 1}};
    if (wrap == Texels::Wrap::mirror) { // extends to the edge if the mirror point lies within
        const bool turns = std::abs(end - begin) != last - first;
        const bool at_end = begin + end >= size - 1;
        const auto [low, high] = std::minmax(begin, end);
        return {turns ? Span{at_end ? low : 0, at_end ? size - 1 : high} : Span{low, high}};
    }
    if (begin <= end)
        return {{begin, end}};
    return {{begin, size - 1}, {0, end}};
}

/// Bounds the filtered value of one level.
class Filter {
public:
    Filter(const TexelLevel& level, uint32_t component, Texels::Wrap wrap)
        : level_(level), component_(component), wrap_(wrap) {}

    /// `places` are coordinates in texels, one for each filtered axis; `layer` is that of a cube.
    Interval at(std::span<const Interval> places, bool linear, int64_t layer) const {
        if (std::ranges::any_of(places, [](const Interval& place) {
                return place.partial || place.low < -k_largest_index || place.high > k_largest_index;
            }))
            return level_.range({0, 0, 0}, last(), component_);
        return linear ? interpolated(places, layer) : nearest(places, layer);
    }

private:
    TexelIndex last() const { return {level_.size()[0] - 1, level_.size()[1] - 1, level_.size()[2] - 1}; }

    Interval nearest(std::span<const Interval> places, int64_t layer) const {
        TexelIndex first{0, 0, layer}, last = first;
        for (size_t axis = 0; axis < places.size(); ++axis) {
            first[axis] = int64_t(std::floor(places[axis].low));
            last[axis] = int64_t(std::floor(places[axis].high));
        }
        return range(first, last, places.size());
    }

    /// Cells lie between texel centres.
    Interval interpolated(std::span<const Interval> places, int64_t layer) const {
        TexelIndex first{0, 0, layer}, last = first;
        std::array<Interval, 3> parts;
        bool few = true;
        for (size_t axis = 0; axis < places.size(); ++axis) {
            parts[axis] = places[axis] - Interval{0.5, 0.5};
            first[axis] = int64_t(std::floor(parts[axis].low));
            last[axis] = int64_t(std::floor(parts[axis].high));
            few = few && last[axis] - first[axis] < k_few_cells;
        }
        if (few)
            return over_cells(first, last, std::span(parts).first(places.size()));
        for (size_t axis = 0; axis < places.size(); ++axis)
            ++last[axis];
        return range(first, last, places.size());
    }

    Interval over_cells(const TexelIndex& first, const TexelIndex& last,
                        std::span<const Interval> parts) const {
        std::optional<Interval> all;
        TexelIndex cell = first;
        for (cell[2] = first[2]; cell[2] <= last[2]; ++cell[2])
            for (cell[1] = first[1]; cell[1] <= last[1]; ++cell[1])
                for (cell[0] = first[0]; cell[0] <= last[0]; ++cell[0]) {
                    const Interval one = in_cell(cell, parts, parts.size());
                    all = all ? hull(*all, one) : one;
                }
        return *all;
    }

    /// Interpolates linearly along the first `axes` axes.
    Interval in_cell(TexelIndex cell, std::span<const Interval> parts, size_t axes) const {
        if (axes == 0) {
            for (size_t axis = 0; axis < parts.size(); ++axis)
                cell[axis] = wrapped(cell[axis], level_.size()[axis], wrap_);
            return level_.range(cell, cell, component_);
        }
        const size_t axis = axes - 1;
        const auto begin = double(cell[axis]);
        Interval share = parts[axis] - Interval{begin, begin};
        share = {std::clamp(share.low, 0.0, 1.0), std::clamp(share.high, 0.0, 1.0)};
        const Interval here = in_cell(cell, parts, axis);
        ++cell[axis];
        return mix(here, in_cell(cell, parts, axis), share);
    }

    Interval range(const TexelIndex& first, const TexelIndex& last, size_t axes) const {
        std::array<std::vector<Span>, 3> spans;
        for (size_t axis = 0; axis < 3; ++axis)
            spans[axis] = axis < axes ? wrapped_spans(first[axis], last[axis], level_.size()[axis], wrap_)
                                      : std::vector<Span>{{first[axis], last[axis]}};
        std::optional<Interval> all;
        for (const Span& z : spans[2])
            for (const Span& y : spans[1])
                for (const Span& x : spans[0]) {
                    const Interval one =
                        level_.range({x.first, y.first, z.first}, {x.second, y.second, z.second}, component_);
                    all = all ? hull(*all, one) : one;
                }
        return *all;
    }

    const TexelLevel& level_;
    uint32_t component_;
    Texels::Wrap wrap_;
};

/// Converts a direction to a face of a cube and coordinates on it in [0, 1]; nullopt if the face is not
/// decided.
struct OnFace {
    int64_t face = 0;
    std::array<Interval, 2> place;
};

std::optional<OnFace> on_face(std::span<const Interval> direction) {
    size_t major = 0;
    for (size_t axis = 1; axis < 3; ++axis)
        if (absolute(direction[axis]).high > absolute(direction[major]).high)
            major = axis;
    const Interval size = absolute(direction[major]);
    for (size_t axis = 0; axis < 3; ++axis)
        if (axis != major && absolute(direction[axis]).high > size.low)
            return std::nullopt;
    if (size.low <= 0)
        return std::nullopt;
    const bool negative = direction[major].high < 0;
    const Interval &x = direction[0], &y = direction[1], &z = direction[2];
    const std::array<std::array<Interval, 2>, 6> sides{
        {{-z, -y}, {z, -y}, {x, z}, {x, -z}, {x, -y}, {-x, -y}}};
    const size_t face = 2 * major + negative;
    const auto part = [&](const Interval& side) { return (side / size + k_one) * Interval{0.5, 0.5}; };
    return OnFace{int64_t(face), {part(sides[face][0]), part(sides[face][1])}};
}

/// Returns the level of a look-up from its operands: level, bias or gradients.
Interval level_of(const Lookup& lookup, std::span<const Interval> operands, const TexelIndex& size) {
    const auto rest = operands.subspan(std::min<size_t>(lookup.coordinates, operands.size()));
    if (lookup.has_level)
        return rest.empty() ? Interval{} : rest[0];
    if (!lookup.has_gradients)
        return lookup.has_bias && !rest.empty() ? maximum(rest[0], {0, 0}) : Interval{};
    Interval longest{0, 0};
    const size_t axes = rest.size() / 2;
    for (const size_t begin : {size_t(0), axes}) {
        Interval length{0, 0};
        for (size_t axis = 0; axis < axes; ++axis) {
            const auto texels = double(size[axis]);
            length = length + square(rest[begin + axis] * Interval{texels, texels});
        }
        longest = maximum(longest, sqrt(length));
    }
    return increasing(std::log2, maximum(longest, k_one), 0);
}

} // namespace

size_t TexelLevel::Extrema::offset(const TexelIndex& index, uint32_t component) const {
    return size_t((index[2] * size[1] + index[1]) * size[0] + index[0]) * k_components + component;
}

TexelLevel::Extrema TexelLevel::halved(const Extrema& from) {
    Extrema to;
    for (size_t axis = 0; axis < 3; ++axis)
        to.size[axis] = (from.size[axis] + 1) / 2;
    const size_t count = size_t(to.size[0] * to.size[1] * to.size[2]) * k_components;
    to.least.assign(count, k_infinite);
    to.largest.assign(count, -k_infinite);
    const std::vector<float>& most = from.largest.empty() ? from.least : from.largest;
    for (int64_t z = 0; z < from.size[2]; ++z)
        for (int64_t y = 0; y < from.size[1]; ++y)
            for (int64_t x = 0; x < from.size[0]; ++x)
                for (uint32_t component = 0; component < k_components; ++component) {
                    const size_t source = from.offset({x, y, z}, component);
                    const size_t target = to.offset({x / 2, y / 2, z / 2}, component);
                    const bool number = !std::isnan(from.least[source]);
                    to.least[target] = number ? std::min(to.least[target], from.least[source]) : -k_infinite;
                    to.largest[target] = number ? std::max(to.largest[target], most[source]) : k_infinite;
                }
    return to;
}

TexelLevel::TexelLevel(TexelIndex size, std::vector<float> rgba) {
    extrema_.push_back({size, std::move(rgba), {}});
    while (std::ranges::max(extrema_.back().size) > k_few)
        extrema_.push_back(halved(extrema_.back()));
}

Interval TexelLevel::range(const TexelIndex& first, const TexelIndex& last, uint32_t component) const {
    int64_t longest = 0;
    for (size_t axis = 0; axis < 3; ++axis)
        longest = std::max(longest, last[axis] - first[axis] + 1);
    size_t chosen = 0;
    while (chosen + 1 < extrema_.size() && longest >> chosen > k_few)
        ++chosen;
    const Extrema& over = extrema_[chosen];
    const std::vector<float>& most = chosen == 0 ? over.least : over.largest;
    Interval all{k_infinity, -k_infinity};
    TexelIndex at{};
    for (at[2] = first[2] >> chosen; at[2] <= last[2] >> chosen; ++at[2])
        for (at[1] = first[1] >> chosen; at[1] <= last[1] >> chosen; ++at[1])
            for (at[0] = first[0] >> chosen; at[0] <= last[0] >> chosen; ++at[0]) {
                const size_t offset = over.offset(at, component);
                if (!std::isfinite(over.least[offset]) || !std::isfinite(most[offset]))
                    return everything();
                all.low = std::min(all.low, double(over.least[offset]));
                all.high = std::max(all.high, double(most[offset]));
            }
    return all;
}

Interval Texels::look_up(const Lookup& lookup, std::span<const Interval> operands,
                         UnnamedLevel unnamed) const {
    switch (lookup.form) {
    case Lookup::Form::sample: return sampled(lookup, operands, unnamed);
    case Lookup::Form::fetch: return fetched(lookup, operands);
    case Lookup::Form::size: {
        const TexelLevel* level = level_at(operands);
        const double size = level ? double(level->size()[lookup.component]) : 0;
        return {size, size};
    }
    case Lookup::Form::gather:
    case Lookup::Form::query: break;
    }
    return everything();
}

const TexelLevel* Texels::level_at(std::span<const Interval> number) const {
    if (number.empty())
        return &levels.front();
    const bool there = number[0].point() && number[0].low >= 0 && number[0].low < double(levels.size());
    return there ? &levels[size_t(number[0].low)] : nullptr;
}

/// Texels beyond the edges are 0.
Interval Texels::fetched(const Lookup& lookup, std::span<const Interval> operands) const {
    const TexelLevel* level = level_at(operands.subspan(lookup.coordinates));
    if (!level)
        return {0, 0};
    TexelIndex first{}, last{};
    bool inside = true;
    for (size_t axis = 0; axis < lookup.coordinates; ++axis) {
        const auto edge = double(level->size()[axis] - 1);
        if (operands[axis].high < 0 || operands[axis].low > edge)
            return {0, 0};
        inside = inside && operands[axis].low >= 0 && operands[axis].high <= edge;
        first[axis] = int64_t(std::max(operands[axis].low, 0.0));
        last[axis] = int64_t(std::min(operands[axis].high, edge));
    }
    const Interval found = level->range(first, last, lookup.component);
    return inside ? found : hull(found, {0, 0});
}

Interval Texels::sampled(const Lookup& lookup, std::span<const Interval> operands,
                         UnnamedLevel unnamed) const {
    const bool any = unnamed == UnnamedLevel::any && chooses_level(lookup);
    const Interval wanted = any ? everything() : level_of(lookup, operands, levels.front().size());
    const auto at = [&](double level, bool linear) {
        return filtered(levels[size_t(level)], lookup, operands, linear);
    };
    if (wanted.high <= 0)
        return at(0, magnify_linear);
    const auto most = double(levels.size() - 1);
    const Interval level{std::clamp(wanted.low, 0.0, most), std::clamp(wanted.high, 0.0, most)};
    const Interval minified = between_levels(level, [&](double number) { return at(number, minify_linear); });
    return wanted.low > 0 || magnify_linear == minify_linear ? minified
                                                             : hull(minified, at(0, magnify_linear));
}

template <class AtLevel>
Interval Texels::between_levels(const Interval& level, AtLevel at) const {
    if (mipmaps == Mipmaps::none)
        return at(0);
    const bool linear = mipmaps == Mipmaps::linear;
    const auto first = int(linear ? std::floor(level.low) : std::round(level.low));
    const auto last = int(linear ? std::ceil(level.high) : std::round(level.high));
    if (linear && last == first + 1)
        return mix(at(first), at(last), level - Interval{double(first), double(first)});
    Interval all = at(first);
    for (int number = first + 1; number <= last; ++number)
        all = hull(all, at(number));
    return all;
}

Interval Texels::filtered(const TexelLevel& level, const Lookup& lookup, std::span<const Interval> operands,
                          bool linear) const {
    std::array<Interval, 3> places{};
    size_t axes = std::min<size_t>(lookup.coordinates, places.size());
    std::copy_n(operands.begin(), axes, places.begin());
    int64_t layer = 0;
    if (kind == Kind::cube) {
        const auto face = on_face(places);
        if (!face)
            return level.range({0, 0, 0}, {level.size()[0] - 1, level.size()[1] - 1, 5}, lookup.component);
        axes = 2;
        layer = face->face;
        std::ranges::copy(face->place, places.begin());
    }
    for (size_t axis = 0; axis < axes; ++axis) {
        const auto size = double(level.size()[axis]);
        places[axis] = places[axis] * Interval{size, size};
    }
    const Wrap beyond = kind == Kind::cube ? Wrap::clamp : wrap;
    return Filter(level, lookup.component, beyond).at(std::span(places).first(axes), linear, layer);
}

Interval look_up(const TextureSet& textures, const Lookup& lookup, std::span<const Interval> operands,
                 UnnamedLevel unnamed) {
    const auto found = textures.find(lookup.sampler);
    return found == textures.end() ? everything() : found->second->look_up(lookup, operands, unnamed);
}

} // namespace tidemark::proof
