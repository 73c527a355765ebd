// Lists the fields of FrameState, from which its JSON and its command line are made. A missing field does not
// compile.
#pragma once

#include "render/frame_state.hpp"

#include <string_view>
#include <tuple>

namespace tidemark::render {

template <class T>
struct FrameField {
    std::string_view name;
    T FrameState::*member;
    std::string_view option{}; ///< of `tidemark capture`; empty: none
};
template <class T>
FrameField(std::string_view, T FrameState::*, std::string_view = {}) -> FrameField<T>; // for clang 14

inline constexpr auto k_frame_fields = std::tuple{
    FrameField{"frame", &FrameState::frame, "--frame"},
    FrameField{"time", &FrameState::time, "--time"},
    FrameField{"size", &FrameState::extent, "--size"},
    FrameField{"fps", &FrameState::fps, "--fps"},
    FrameField{"time_delta", &FrameState::time_delta},
    FrameField{"mouse", &FrameState::mouse, "--mouse"},
    FrameField{"right_button", &FrameState::right_button},
    FrameField{"keys", &FrameState::keys},
    FrameField{"date", &FrameState::date, "--date"},
    FrameField{"camera", &FrameState::camera, "--camera"},
    FrameField{"initial_camera", &FrameState::initial_camera},
    FrameField{"knobs", &FrameState::knobs, "--set"},
    FrameField{"definitions", &FrameState::definitions, "--define"},
    FrameField{"channels", &FrameState::channels, "--channel"},
    FrameField{"pass", &FrameState::pass, "--pass"},
};

/// Ties all members of a state; compiles only if the number of names is the number of fields.
constexpr auto tied(const FrameState& state) {
    const auto& [f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15] = state;
    return std::tie(f1, f2, f3, f4, f5, f6, f7, f8, f9, f10, f11, f12, f13, f14, f15);
}
static_assert(std::tuple_size_v<decltype(k_frame_fields)> ==
              std::tuple_size_v<decltype(tied(std::declval<FrameState>()))>);

/// Calls `see(field)` for each row.
template <class See>
void for_each_field(See&& see) {
    std::apply([&](const auto&... field) { (see(field), ...); }, k_frame_fields);
}

} // namespace tidemark::render
