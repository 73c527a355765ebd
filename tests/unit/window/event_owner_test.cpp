// The owner of an event, from where it begins to where it ends.
#include "host/overlay_model.hpp"

#include <gtest/gtest.h>

namespace tidemark::overlay::event_owner_test {

using namespace host;

constexpr EventOwner::Wishes k_over_a_panel{true, false};
constexpr EventOwner::Wishes k_elsewhere{false, false};
constexpr EventOwner::Wishes k_typing{false, true};

TEST(EventOwner, a_drag_started_on_a_panel_stays_with_the_panel) {
    EventOwner owner;
    EXPECT_TRUE(owner.take(ButtonPressed{}, k_over_a_panel));
    EXPECT_TRUE(owner.take(PointerMoved{}, k_elsewhere));
    EXPECT_TRUE(owner.take(ButtonReleased{}, k_elsewhere));
    EXPECT_FALSE(owner.take(PointerMoved{}, k_elsewhere));
}

TEST(EventOwner, a_drag_started_in_the_scene_stays_with_the_scene) {
    EventOwner owner;
    EXPECT_FALSE(owner.take(ButtonPressed{}, k_elsewhere));
    EXPECT_FALSE(owner.take(PointerMoved{}, k_over_a_panel));
    EXPECT_FALSE(owner.take(ButtonReleased{}, k_over_a_panel));
}

TEST(EventOwner, keys_go_to_the_field_while_typing) {
    EventOwner owner;
    EXPECT_FALSE(owner.take(KeyPressed{Key::a}, k_over_a_panel));
    EXPECT_FALSE(owner.take(KeyReleased{Key::a}, k_typing)) << "the scene saw it go down";
    EXPECT_TRUE(owner.take(KeyPressed{Key::enter}, k_typing));
    EXPECT_TRUE(owner.take(TextTyped{U'1'}, k_typing));
    EXPECT_TRUE(owner.take(KeyReleased{Key::enter}, k_elsewhere));
}

TEST(EventOwner, window_events_never_go_to_a_panel) {
    EventOwner owner;
    EXPECT_FALSE(owner.take(CloseRequested{}, k_over_a_panel));
    EXPECT_FALSE(owner.take(FramebufferResized{{1, 1}}, k_over_a_panel));
}

} // namespace tidemark::overlay::event_owner_test
