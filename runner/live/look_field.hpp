// How the large picture is viewed: channels, exposure, the slice of a volume. Draws nothing.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace tidemark::live {

/// A choice of the channels to show.
struct ChannelChoice {
    std::string_view name;
    std::optional<int> channel{}; ///< none: red, green and blue
    std::optional<int> less{};    ///< subtracted from `channel`
};

inline constexpr std::array<ChannelChoice, 11> k_channel_choices{{{"RGB"},
                                                                  {"R", 0},
                                                                  {"G", 1},
                                                                  {"B", 2},
                                                                  {"A", 3},
                                                                  {"R - G", 0, 1},
                                                                  {"R - B", 0, 2},
                                                                  {"R - A", 0, 3},
                                                                  {"G - B", 1, 2},
                                                                  {"G - A", 1, 3},
                                                                  {"B - A", 2, 3}}};

inline constexpr double k_most_stops = 16;

struct LookField {
    size_t channels = 0;        ///< index into k_channel_choices
    double stops = 0;           ///< exposure; in automatic mode the resulting value
    bool automatic = false;     ///< the brightest value is just not clipped
    std::optional<int> slice{}; ///< of a volume; none: the middle one

    bool operator==(const LookField&) const = default;
};

} // namespace tidemark::live
