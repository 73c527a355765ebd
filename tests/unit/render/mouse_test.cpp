// iMouse by ShaderToy's rules: whole pixels, z > 0 while the button is down, w > 0 in the first frame after
// the press only.
#include "render/frame_state.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace tidemark::render::mouse_test {

TEST(Mouse, starts_at_zero) {
    const glm::vec4 mouse = Mouse().uniform();
    EXPECT_EQ(mouse, glm::vec4(0));
    for (int i = 0; i < 4; ++i)
        EXPECT_FALSE(std::signbit(mouse[i])) << i;
}

TEST(Mouse, a_press_is_a_click_for_one_frame) {
    Mouse mouse;
    mouse.press(30, 40);
    EXPECT_EQ(mouse.uniform(), glm::vec4(30, 40, 30, 40));
    EXPECT_EQ(mouse.uniform(), glm::vec4(30, 40, 30, 40)) << "until a frame is drawn";
    mouse.frame_drawn();
    EXPECT_EQ(mouse.uniform(), glm::vec4(30, 40, 30, -40));
    mouse.frame_drawn();
    EXPECT_EQ(mouse.uniform(), glm::vec4(30, 40, 30, -40));
}

TEST(Mouse, a_drag_moves_xy_and_keeps_the_press) {
    Mouse mouse;
    mouse.press(30, 40);
    mouse.frame_drawn();
    mouse.move(35, 50);
    EXPECT_EQ(mouse.uniform(), glm::vec4(35, 50, 30, -40));
    mouse.move(36, 51);
    EXPECT_EQ(mouse.uniform(), glm::vec4(36, 51, 30, -40));
}

TEST(Mouse, a_drag_within_the_first_frame_is_still_a_click) {
    Mouse mouse;
    mouse.press(30, 40);
    mouse.move(35, 50);
    EXPECT_EQ(mouse.uniform(), glm::vec4(35, 50, 30, 40));
}

TEST(Mouse, a_release_keeps_xy_and_negates_z) {
    Mouse mouse;
    mouse.press(30, 40);
    mouse.frame_drawn();
    mouse.move(35, 50);
    mouse.release();
    EXPECT_EQ(mouse.uniform(), glm::vec4(35, 50, -30, -40));
    mouse.frame_drawn();
    mouse.move(99, 99);
    EXPECT_EQ(mouse.uniform(), glm::vec4(35, 50, -30, -40)) << "no button, no movement";
}

TEST(Mouse, a_click_within_one_frame_is_kept) {
    Mouse mouse;
    mouse.press(30, 40);
    mouse.release();
    EXPECT_EQ(mouse.uniform(), glm::vec4(30, 40, -30, 40));
    mouse.frame_drawn();
    EXPECT_EQ(mouse.uniform(), glm::vec4(30, 40, -30, -40));
}

TEST(Mouse, moving_without_a_press_does_nothing) {
    Mouse mouse;
    mouse.move(30, 40);
    EXPECT_EQ(mouse.uniform(), glm::vec4(0));
}

TEST(Mouse, a_second_press_starts_a_new_drag) {
    Mouse mouse;
    mouse.press(30, 40);
    mouse.frame_drawn();
    mouse.release();
    mouse.press(7, 8);
    EXPECT_EQ(mouse.uniform(), glm::vec4(7, 8, 7, 8));
}

TEST(Mouse, pixels_are_whole) {
    Mouse mouse;
    mouse.press(30.99, 40.01);
    EXPECT_EQ(mouse.uniform(), glm::vec4(30, 40, 30, 40));
    mouse.move(-0.5, -1.5); // dragged out of the window
    EXPECT_EQ(mouse.uniform(), glm::vec4(-1, -2, 30, 40));
}

TEST(Mouse, a_press_at_pixel_zero_is_never_a_negative_zero) {
    for (const double zero : {0.0, 0.7, -0.0}) {
        Mouse mouse;
        mouse.press(zero, zero);
        for (int frame = 0; frame < 3; ++frame) {
            const glm::vec4 uniform = mouse.uniform();
            EXPECT_EQ(uniform, glm::vec4(0));
            for (int i = 0; i < 4; ++i)
                EXPECT_FALSE(std::signbit(uniform[i])) << "component " << i << " of frame " << frame;
            mouse.frame_drawn();
            if (frame == 1)
                mouse.release();
        }
    }
}

} // namespace tidemark::render::mouse_test
