// Draws the numbers of a lens: colours, a bar and a legend in letters of five by seven pixels.

#include "lab/lens.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tidemark::lab {
namespace {

using ByteColour = std::array<uint8_t, 3>;

/// Colours of rising brightness along one line from blue to yellow, which all usual colour-blind eyes see in
/// the same order (after J. R. Nunez, C. R. Anderton, R. S. Renslow: Optimizing colormaps with consideration
/// for color vision deficiency, PLoS ONE 13(7), 2018).
constexpr ByteColour k_ramp[] = {{0, 32, 77},     {0, 51, 111},    {57, 72, 107},   {87, 92, 109},
                                 {112, 113, 115}, {138, 135, 121}, {166, 157, 117}, {196, 181, 108},
                                 {228, 207, 91},  {255, 234, 70}};

constexpr ByteColour k_absent{0, 0, 0}, k_marked_colour{255, 255, 255}, k_nan{255, 0, 255},
    k_infinite{0, 255, 255};
constexpr ByteColour k_paper{20, 21, 24}, k_ink{230, 230, 230}, k_faint{165, 166, 170};

/// Columns of the letters from ' ' to '~', five bytes each; bit 0 is the top row.
constexpr std::string_view k_letters = "000000000000005f00000007000700147f147f14242a7f2a12"
                                       "231308646236495620500008070300001c2241000041221c00"
                                       "2a1c7f1c2a08083e0808008070300008080808080000606000"
                                       "20100804023e5149453e00427f400072494949462141494d33"
                                       "1814127f1027454545393c4a49493141211109073649494936"
                                       "464949291e0000140000004034000000081422411414141414"
                                       "004122140802015909063e415d594e7c1211127c7f49494936"
                                       "3e414141227f4141413e7f494949417f090909013e41415173"
                                       "7f0808087f00417f41002040413f017f081422417f40404040"
                                       "7f021c027f7f0408107f3e4141413e7f090909063e4151215e"
                                       "7f09192946264949493203017f01033f4040403f1f2040201f"
                                       "3f4038403f631408146303047804036159494d43007f414141"
                                       "0204081020004141417f040201020440404040400003070800"
                                       "20545478407f284444383844444428384444287f3854545418"
                                       "00087e090218a4a49c787f0804047800447d40002040403d00"
                                       "7f1028440000417f40007c047804787c080404783844444438"
                                       "fc1824241818242418fc7c08040408485454542404043f4424"
                                       "3c4040207c1c2040201c3c4030403c44281028444c9090907c"
                                       "4464544c440008364100000077000000413608000201020402";

constexpr int k_letter_width = 6, k_row_height = 11, k_margin = 4, k_bar_height = 9;
constexpr int k_narrowest = 240;

/// Returns the largest number of rows of text, above the bar and below it.
int most_rows(int letters) {
    return letters >= 80 ? 8 : letters >= 50 ? 12 : 16;
}

unsigned column_of(char letter, int column) {
    if (letter < ' ' || letter > '~')
        letter = '?';
    const size_t at = size_t(letter - ' ') * 10 + size_t(column) * 2;
    const auto digit = [](char c) { return unsigned(c <= '9' ? c - '0' : c - 'a' + 10); };
    return 16 * digit(k_letters[at]) + digit(k_letters[at + 1]);
}

/// A picture of RGBA bytes that is drawn from its top.
class LensCanvas {
public:
    LensCanvas(Extent extent, int scale) : image_(extent, 4, image::SampleType::u8), scale_(scale) {}

    int width() const { return image_.extent.width / scale_; }

    void put(int x, int y, const ByteColour& colour) {
        if (x < 0 || y < 0 || x >= image_.extent.width || y >= image_.extent.height)
            return;
        const size_t row = size_t(image_.extent.height - 1 - y);
        uint8_t* const at = &image_.u8()[4 * (row * size_t(image_.extent.width) + size_t(x))];
        std::copy(colour.begin(), colour.end(), at);
        at[3] = 255;
    }

    /// Fills a box of scaled pixels.
    void fill(int x, int y, int width, int height, const ByteColour& colour) {
        for (int row = y * scale_; row < (y + height) * scale_; ++row)
            for (int column = x * scale_; column < (x + width) * scale_; ++column)
                put(column, row, colour);
    }

    void write(int x, int y, std::string_view words, const ByteColour& colour) {
        for (size_t i = 0; i < words.size(); ++i)
            for (int column = 0; column < 5; ++column)
                for (int row = 0; row < 8; ++row)
                    if (column_of(words[i], column) >> row & 1)
                        fill(x + int(i) * k_letter_width + column, y + row, 1, 1, colour);
    }

    image::Image take() { return std::move(image_); }

private:
    image::Image image_;
    int scale_;
};

int scale_of(int width) {
    return std::max(1, width / 640);
}

/// Returns how many letters a row has.
int letters_of(int width) {
    return (width / scale_of(width) - 2 * k_margin) / k_letter_width;
}

} // namespace

std::string legend_number(double value) {
    if (!std::isfinite(value))
        return std::isnan(value) ? "none" : value > 0 ? "inf" : "-inf";
    const double size = std::abs(value);
    return size >= 1e4 && size < 1e7 ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

std::string share_words(double share) {
    const double percent = 100 * share, rest = 100 - percent;
    if (percent < 99 || rest <= 0)
        return fmt::format("{:.3g} %", percent);
    return fmt::format("{:.{}f} %", percent, std::clamp(int(std::ceil(-std::log10(rest))), 1, 12));
}

namespace {

std::string share_words(size_t part, size_t whole) {
    return lab::share_words(whole == 0 ? 0.0 : double(part) / double(whole));
}

/// Returns 1, 2 or 5 times a power of ten, at least `value`.
double round_up(double value) {
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double factor : {1.0, 2.0, 5.0, 10.0})
        if (factor * power >= value * (1 - 1e-9))
            return factor * power;
    return 10 * power;
}

} // namespace

double place_on_bar(const LensPlan& plan, const LensRange& range, double value) {
    if (plan.logarithmic)
        return value <= range.low
                   ? 0
                   : std::clamp(std::log(value / range.low) / std::log(range.high / range.low), 0.0, 1.0);
    return std::clamp((value - range.low) / (range.high - range.low), 0.0, 1.0);
}

namespace {

ByteColour colour_at(const LensPlan& plan, const LensNumbers& numbers, const LensRange& range, size_t pixel) {
    if (numbers.marks[pixel] == LensNumbers::Mark::absent)
        return k_absent;
    if (numbers.marks[pixel] == LensNumbers::Mark::marked)
        return k_marked_colour;
    for (int k = 0; k < numbers.components; ++k)
        if (std::isnan(numbers.at(pixel, k)))
            return k_nan;
    for (int k = 0; k < numbers.components; ++k)
        if (std::isinf(numbers.at(pixel, k)))
            return k_infinite;
    if (!plan.classes.empty())
        return plan.classes[std::min(size_t(numbers.at(pixel)), plan.classes.size() - 1)].colour;
    if (numbers.components == 1)
        return lens_colour(place_on_bar(plan, range, double(numbers.at(pixel))));
    ByteColour colour{};
    for (int k = 0; k < 3; ++k)
        colour[size_t(k)] =
            uint8_t(std::lround(255 * place_on_bar(plan, range, double(numbers.at(pixel, k)))));
    return colour;
}

/// Returns whether a neighbour to the right or above went another way.
bool parts_there(const LensNumbers& numbers, size_t pixel) {
    const auto width = size_t(numbers.extent.width);
    const auto differs = [&](size_t other) {
        return numbers.marks[pixel] == LensNumbers::Mark::number &&
               numbers.marks[other] == LensNumbers::Mark::number && numbers.at(pixel) != numbers.at(other);
    };
    return (pixel % width + 1 < width && differs(pixel + 1)) ||
           (pixel + width < numbers.marks.size() && differs(pixel + width));
}

void add_to(LensSummary& summary, const LensNumbers& numbers, size_t pixel, std::vector<double>& finite) {
    summary.marked += numbers.marks[pixel] == LensNumbers::Mark::marked;
    bool nan = false, infinite = false;
    for (int k = 0; k < numbers.components; ++k) {
        const auto value = double(numbers.at(pixel, k));
        nan = nan || std::isnan(value);
        infinite = infinite || std::isinf(value);
        if (std::isfinite(value))
            finite.push_back(value);
    }
    summary.nan += nan;
    summary.infinite += infinite && !nan;
}

} // namespace

LensSummary summary_of(const LensPlan& plan, const LensNumbers& numbers) {
    LensSummary summary;
    summary.pixels = numbers.marks.size();
    summary.classes.assign(plan.classes.size(), 0);
    std::vector<double> finite;
    for (size_t i = 0; i < numbers.marks.size(); ++i) {
        if (numbers.marks[i] == LensNumbers::Mark::absent)
            continue;
        ++summary.numbers;
        add_to(summary, numbers, i, finite);
        if (!plan.classes.empty()) {
            ++summary.classes[std::min(size_t(numbers.at(i)), plan.classes.size() - 1)];
            summary.parting += parts_there(numbers, i);
        }
    }
    std::ranges::sort(finite);
    summary.least = finite.empty() ? std::nan("") : finite.front();
    summary.most = finite.empty() ? std::nan("") : finite.back();
    summary.median = quantile_of_sorted(finite, 0.5);
    summary.p99 = quantile_of_sorted(finite, 0.99);
    return summary;
}

LensRange range_of(const LensPlan& plan, const LensSummary& summary) {
    if (!std::isfinite(summary.least))
        return {0, 1};
    if (plan.logarithmic) {
        constexpr double k_decades = 6;
        const double high = summary.most > 0 ? std::pow(10, std::ceil(std::log10(summary.most))) : 1;
        return {high * std::pow(10, -k_decades), high};
    }
    // The few pixels with most steps must not make all others look the same.
    const bool has_outliers = plan.lens.name == LensName::cost || plan.lens.name == LensName::clocks ||
                              plan.lens.name == LensName::steps;
    const double most =
        has_outliers && summary.p99 > 0 ? std::min(summary.most, 2 * summary.p99) : summary.most;
    const double size = std::max(std::abs(summary.least), std::abs(most));
    if (!(size > 0))
        return {0, 1};
    const double high = round_up(size);
    if (summary.least >= 0 && (plan.lens.name != LensName::value || summary.least < 0.5 * summary.most))
        return {0, high};
    if (summary.most <= 0 && summary.most > 0.5 * summary.least)
        return {-high, 0};
    const double width = summary.most - summary.least;
    const double step = width > 0 ? round_up(width) / 10 : size / 10;
    return {std::floor(summary.least / step) * step, std::ceil(summary.most / step + 1e-9) * step};
}

std::array<uint8_t, 3> lens_colour(double part) {
    constexpr int k_last = int(std::size(k_ramp)) - 1;
    const double place = std::clamp(part, 0.0, 1.0) * k_last;
    const int below = std::min(int(place), k_last - 1);
    ByteColour colour{};
    for (size_t i = 0; i < 3; ++i)
        colour[i] = uint8_t(
            std::lround(std::lerp(double(k_ramp[below][i]), double(k_ramp[below + 1][i]), place - below)));
    return colour;
}

image::Image lens_map(const LensPlan& plan, const LensNumbers& numbers) {
    image::Image map(numbers.extent, 4, image::SampleType::u8);
    const LensRange range = range_of(plan, summary_of(plan, numbers));
    const auto samples = map.u8();
    for (size_t i = 0; i < numbers.marks.size(); ++i) {
        ByteColour colour = colour_at(plan, numbers, range, i);
        if (plan.lens.name == LensName::branch && parts_there(numbers, i))
            colour = k_marked_colour;
        std::ranges::copy(colour, samples.begin() + ptrdiff_t(4 * i));
        samples[4 * i + 3] = 255;
    }
    return map;
}

std::vector<LegendEntry> legend_of(const LensPlan& plan, const LensSummary& summary,
                                   const LensNumbers& numbers) {
    std::vector<LegendEntry> entries;
    if (plan.classes.empty()) {
        entries.push_back({{}, "min " + legend_number(summary.least)});
        entries.push_back({{}, "median " + legend_number(summary.median)});
        entries.push_back({{}, "99 % below " + legend_number(summary.p99)});
        entries.push_back({{}, "max " + legend_number(summary.most)});
    }
    for (size_t i = 0; i < plan.classes.size(); ++i)
        if (summary.classes[i] > 0 || i < 2)
            entries.push_back(
                {plan.classes[i].colour, fmt::format("{} {}", plan.classes[i].name,
                                                     share_words(summary.classes[i], summary.pixels))});
    if (plan.lens.name == LensName::branch)
        entries.push_back(
            {k_marked_colour, "neighbours part " + share_words(summary.parting, summary.pixels)});
    if (!plan.marked.empty())
        entries.push_back({k_marked_colour, plan.marked + " " + share_words(summary.marked, summary.pixels)});
    if (summary.nan > 0)
        entries.push_back({k_nan, "NaN " + share_words(summary.nan, summary.pixels)});
    if (summary.infinite > 0)
        entries.push_back({k_infinite, "infinite " + share_words(summary.infinite, summary.pixels)});
    if (const size_t absent = summary.pixels - summary.numbers; absent > 0)
        entries.push_back({k_absent, fmt::format("{} {}", numbers.complete ? plan.absent : "not known yet",
                                                 share_words(absent, summary.pixels))});
    if (!numbers.note.empty())
        entries.push_back({{}, numbers.note});
    return entries;
}

std::string basis_line(const LensPlan& plan) {
    return fmt::format("{}{}, {}{}{}", to_string(plan.lens.name), plan.unit.empty() ? "" : ": " + plan.unit,
                       to_string(plan.basis), plan.more_basis.empty() ? "" : ", " + plan.more_basis,
                       plan.logarithmic ? ", logarithmic" : "");
}

namespace {

/// Returns rows of at most so many letters, broken at blanks where there are any.
std::vector<std::string> in_rows(std::string words, size_t letters) {
    std::vector<std::string> rows;
    while (words.size() > letters) {
        const size_t blank = words.rfind(' ', letters);
        const bool breaks = blank != words.npos && blank > 0;
        rows.push_back(words.substr(0, breaks ? blank : letters));
        words.erase(0, breaks ? blank + 1 : letters);
    }
    rows.push_back(std::move(words));
    return rows;
}

void draw_bar(LensCanvas& canvas, int y, const LensPlan& plan, const LensNumbers& numbers,
              const LensSummary& summary) {
    const LensRange range = range_of(plan, summary);
    const int width = canvas.width() - 2 * k_margin;
    for (int x = 0; x < width; ++x) {
        const double part = width > 1 ? double(x) / (width - 1) : 0;
        const auto grey = uint8_t(std::lround(255 * part));
        canvas.fill(k_margin + x, y, 1, k_bar_height,
                    numbers.components == 1 ? lens_colour(part) : ByteColour{grey, grey, grey});
    }
    const double middle =
        plan.logarithmic ? std::sqrt(range.low * range.high) : std::lerp(range.low, range.high, 0.5);
    const int below = y + k_bar_height + 2;
    const auto place = [&](double value, int at, std::string_view more = {}) {
        const std::string words = legend_number(value) + std::string(more);
        const int length = int(words.size()) * k_letter_width;
        canvas.write(std::clamp(at - length / 2, k_margin, k_margin + width - length + 1), below, words,
                     k_faint);
    };
    place(range.low, k_margin);
    place(middle, k_margin + width / 2);
    place(range.high, k_margin + width, summary.most > range.high ? " and more" : "");
}

/// Words at a place of the legend.
struct PlacedWords {
    int x = 0, row = 0; ///< x in scaled pixels
    std::optional<ByteColour> box{};
    std::string words;
};

constexpr int k_box = 8, k_gap = 12;

/// Places the entries from left to right. An entry that is longer than a row has rows of its own.
std::vector<PlacedWords> placed(const std::vector<LegendEntry>& entries, int letters) {
    const int end = k_margin + letters * k_letter_width;
    std::vector<PlacedWords> places;
    int x = k_margin, row = 0;
    for (const LegendEntry& entry : entries) {
        const int box = entry.box ? k_box + 3 : 0;
        const int length = box + int(entry.words.size()) * k_letter_width;
        if (x > k_margin && x + length > end) {
            x = k_margin;
            ++row;
        }
        const std::vector<std::string> parts =
            in_rows(entry.words, size_t(letters - (box + k_letter_width - 1) / k_letter_width));
        for (size_t i = 0; i < parts.size(); ++i)
            places.push_back({x, i == 0 ? row : ++row, i == 0 ? entry.box : std::nullopt, parts[i]});
        x = parts.size() > 1 ? end : x + length + k_gap;
    }
    return places;
}

/// The text of a legend in rows.
struct LegendText {
    std::vector<std::string> title, basis;
    bool bar = true;
    std::vector<PlacedWords> entries;

    int entry_rows() const { return entries.empty() ? 0 : entries.back().row + 1; }
    int rows() const { return int(title.size() + basis.size()) + (bar ? 1 : 0) + entry_rows(); }
};

LegendText text_of(const LensPlan& plan, const LensSummary& summary, const LensNumbers& numbers,
                   int letters) {
    return {.title = in_rows(plan.title, size_t(letters)),
            .basis = in_rows(basis_line(plan), size_t(letters)),
            .bar = plan.classes.empty(),
            .entries = placed(legend_of(plan, summary, numbers), letters)};
}

/// Replaces the end of words that are cut off.
void end_with_dots(std::string& words) {
    words = words.substr(0, words.size() < 3 ? 0 : words.size() - 3) + "...";
}

/// Leaves out what does not fit `rows`: entries first, then the end of the title.
void limit_rows(LegendText& text, int rows) {
    const int others = int(text.basis.size()) + (text.bar ? 1 : 0);
    const auto title = size_t(std::max(1, rows - others));
    if (text.title.size() > title) {
        text.title.resize(title);
        end_with_dots(text.title.back());
    }
    const int left = rows - others - int(text.title.size()), before = text.entry_rows();
    std::erase_if(text.entries, [&](const PlacedWords& each) { return each.row >= left; });
    if (text.entry_rows() < before && !text.entries.empty())
        end_with_dots(text.entries.back().words);
}

/// Returns the longest entries that a frame of the plan is likely to have: all kinds of pixels, long numbers.
LegendText longest_text(const LensPlan& plan, int letters) {
    constexpr double k_long = -1.234e-5;
    LensSummary summary{.pixels = 1000, .marked = 123, .nan = 123, .infinite = 123, .parting = 123};
    summary.least = summary.median = summary.p99 = summary.most = k_long;
    summary.classes.assign(plan.classes.size(), 123);
    summary.numbers = summary.pixels - (plan.absent.empty() ? 0 : 123);
    LensNumbers numbers;
    if (plan.lens.name == LensName::rounding || plan.lens.name == LensName::proof)
        numbers.note.assign(70, 'm');
    LensPlan longest = plan;
    if (plan.lens.name == LensName::cost) // the weights of the device are known later
        longest.more_basis.resize(std::max<size_t>(longest.more_basis.size(), 60), 'm');
    return text_of(longest, summary, numbers, letters);
}

/// Returns the size of a picture whose legend has so many rows.
Extent extent_of(Extent map, int rows, bool bar) {
    const int width = std::max(map.width + map.width % 2, k_narrowest), scale = scale_of(width);
    const int below = 2 * k_margin + rows * k_row_height + (bar ? k_bar_height + 2 : 0);
    const int height = (map.height + scale - 1) / scale * scale + scale * below;
    return {width, height + height % 2};
}

/// Returns how many letters a row of the legend below a map has.
int letters_below(Extent map) {
    return letters_of(extent_of(map, 0, false).width);
}

int limited_rows(const LegendText& text, int letters) {
    return std::min(text.rows(), most_rows(letters));
}

/// Draws rows of words. Returns the place below them.
int draw_rows(LensCanvas& canvas, int y, const std::vector<std::string>& rows, const ByteColour& colour) {
    for (const std::string& row : rows) {
        canvas.write(k_margin, y, row, colour);
        y += k_row_height;
    }
    return y;
}

void draw_entries(LensCanvas& canvas, int top, const std::vector<PlacedWords>& entries) {
    for (const auto& [x, row, box, words] : entries) {
        const int y = top + row * k_row_height;
        if (box) {
            canvas.fill(x, y - 1, k_box, k_box + 1, k_faint);
            canvas.fill(x + 1, y, k_box - 2, k_box - 1, *box);
        }
        canvas.write(x + (box ? k_box + 3 : 0), y, words, k_ink);
    }
}

} // namespace

Extent largest_legend_extent(Extent map) {
    return extent_of(map, most_rows(letters_below(map)), true);
}

Extent legend_extent(const LensPlan& plan, Extent map) {
    const int letters = letters_below(map);
    const LegendText text = longest_text(plan, letters);
    return extent_of(map, limited_rows(text, letters), text.bar);
}

image::Image draw_lens(const LensPlan& plan, const LensNumbers& numbers, std::optional<Extent> extent) {
    const LensSummary summary = summary_of(plan, numbers);
    const Extent map_extent = numbers.extent;
    const int letters = letters_below(map_extent);
    LegendText text = text_of(plan, summary, numbers, letters);
    if (!extent)
        extent = extent_of(map_extent, limited_rows(text, letters), text.bar);
    const int scale = scale_of(extent->width);
    LensCanvas canvas(*extent, scale);
    for (int y = 0; y < extent->height; ++y)
        for (int x = 0; x < extent->width; ++x)
            canvas.put(x, y, k_paper);
    const image::Image map = lens_map(plan, numbers);
    const auto samples = map.u8();
    for (int y = 0; y < map_extent.height; ++y)
        for (int x = 0; x < map_extent.width; ++x) {
            const size_t at = 4 * (size_t(map_extent.height - 1 - y) * size_t(map_extent.width) + size_t(x));
            canvas.put(x, y, {samples[at], samples[at + 1], samples[at + 2]});
        }
    // The canvas counts scaled pixels from here on; the map's height may not be a multiple of the scale.
    int y = (map_extent.height + scale - 1) / scale + k_margin;
    const int below = extent->height / scale - y - k_margin - (text.bar ? k_bar_height + 2 : 0);
    limit_rows(text, below / k_row_height);
    y = draw_rows(canvas, y, text.title, k_ink);
    y = draw_rows(canvas, y, text.basis, k_faint);
    if (text.bar) {
        draw_bar(canvas, y, plan, numbers, summary);
        y += k_bar_height + 2 + k_row_height;
    }
    draw_entries(canvas, y, text.entries);
    return canvas.take();
}

std::vector<std::string> legend_lines(const LensPlan& plan, const LensNumbers& numbers) {
    const LensSummary summary = summary_of(plan, numbers);
    std::vector<std::string> lines{plan.title, basis_line(plan)};
    std::string words;
    for (const LegendEntry& entry : legend_of(plan, summary, numbers))
        words += (words.empty() ? "" : ", ") + entry.words;
    lines.push_back(std::move(words));
    return lines;
}

} // namespace tidemark::lab
