// Whose an event is, from where it begins to where it ends.
#include "host/overlay_model.hpp"

#include <gtest/gtest.h>

namespace tidemark::live::event_owner_test {

using namespace platform;

constexpr EventOwner::Wishes k_over_a_panel{true, false};
constexpr EventOwner::Wishes k_elsewhere{false, false};
constexpr EventOwner::Wishes k_typing{false, true};

TEST(EventOwner, a_drag_that_begins_on_a_panel_is_the_panels_to_its_end) {
    EventOwner owner;
    EXPECT_TRUE(owner.take(ButtonPressed{}, k_over_a_panel));
    EXPECT_TRUE(owner.take(PointerMoved{}, k_elsewhere));
    EXPECT_TRUE(owner.take(ButtonReleased{}, k_elsewhere));
    EXPECT_FALSE(owner.take(PointerMoved{}, k_elsewhere));
}

TEST(EventOwner, a_drag_that_begins_in_the_scene_is_the_scenes_to_its_end) {
    EventOwner owner;
    EXPECT_FALSE(owner.take(ButtonPressed{}, k_elsewhere));
    EXPECT_FALSE(owner.take(PointerMoved{}, k_over_a_panel));
    EXPECT_FALSE(owner.take(ButtonReleased{}, k_over_a_panel));
}

TEST(EventOwner, keys_are_a_fields_while_somebody_types) {
    EventOwner owner;
    EXPECT_FALSE(owner.take(KeyPressed{Key::a}, k_over_a_panel));
    EXPECT_FALSE(owner.take(KeyReleased{Key::a}, k_typing)) << "the scene saw it go down";
    EXPECT_TRUE(owner.take(KeyPressed{Key::enter}, k_typing));
    EXPECT_TRUE(owner.take(TextTyped{U'1'}, k_typing));
    EXPECT_TRUE(owner.take(KeyReleased{Key::enter}, k_elsewhere));
}

TEST(EventOwner, the_window_itself_is_nobodys_panel) {
    EventOwner owner;
    EXPECT_FALSE(owner.take(CloseRequested{}, k_over_a_panel));
    EXPECT_FALSE(owner.take(FramebufferResized{{1, 1}}, k_over_a_panel));
}

} // namespace tidemark::live::event_owner_test
