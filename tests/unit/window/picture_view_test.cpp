// How the picture is shown, as far as no driver is needed: scale, freeze, marks, magnifier, the large
// picture.
#include "window/picture_view.hpp"

#include <gtest/gtest.h>

namespace tidemark::window::picture_view_test {

constexpr Extent k_window{640, 360};

PictureView scaled(const char* scale) {
    return PictureView(*RenderScale::named(scale));
}

TEST(PictureView, draws_at_its_scale) {
    EXPECT_EQ(scaled("1/2").drawn(k_window), (Extent{320, 180}));
    PictureView view = scaled("1");
    view.set_scale(view.scale().stepped(1));
    EXPECT_EQ(view.drawn(k_window), (Extent{1280, 720}));
}

TEST(PictureView, converts_places_to_pixels_of_the_picture) {
    const PictureView view = scaled("1/4");
    const auto moved = std::get<host::PointerMoved>(view.in_picture(host::PointerMoved{{320, 90}}, k_window));
    EXPECT_EQ(moved.at.x, 80);
    EXPECT_EQ(moved.at.y, 22.5);
    const auto pressed = std::get<host::ButtonPressed>(
        view.in_picture(host::ButtonPressed{host::Button::right, {640, 360}}, k_window));
    EXPECT_EQ(pressed.button, host::Button::right);
    EXPECT_EQ(pressed.at.x, 160);
    const host::WheelTurned wheel{0, 3};
    EXPECT_EQ(std::get<host::WheelTurned>(view.in_picture(wheel, k_window)), wheel) << "it has no place";
    EXPECT_NO_THROW(view.in_picture(host::PointerMoved{{3, 4}}, {0, 0})) << "a minimised window";
}

TEST(PictureView, adapts_the_scale_only_on_request) {
    PictureView view = scaled("1");
    for (int frame = 0; frame < 100; ++frame)
        EXPECT_EQ(view.scale_after(500), view.scale());
    view.adapt_to(60);
    EXPECT_TRUE(view.adapts());
    RenderScale wanted = view.scale();
    for (int frame = 0; frame < 5; ++frame)
        wanted = view.scale_after(40); // of 16.7 ms
    EXPECT_EQ(wanted.name(), "1/2");
    for (int frame = 0; frame < 4; ++frame)
        view.scale_after(40);
    view.forget_times();
    EXPECT_EQ(view.scale_after(40).name(), "1") << "five frames are needed again";
    view.adapt_to(std::nullopt);
    EXPECT_FALSE(view.adapts());
}

TEST(PictureView, keeps_a_frozen_frame) {
    PictureView view = scaled("1");
    EXPECT_EQ(view.frozen(), nullptr);
    Frozen frame;
    frame.picture.frame = 7;
    view.freeze(std::move(frame));
    ASSERT_NE(view.frozen(), nullptr);
    EXPECT_EQ(view.frozen()->picture.frame, 7);
    view.leave_context(); // a reload keeps it
    ASSERT_NE(view.frozen(), nullptr);
    view.freeze(std::nullopt);
    EXPECT_EQ(view.frozen(), nullptr);
}

TEST(PictureView, magnifies_the_pixel_under_the_pointer) {
    PictureView view = scaled("1/4");
    EXPECT_FALSE(view.follow(host::PointerMoved{{1, 1}})) << "it is closed";
    view.toggle_magnifier();
    EXPECT_TRUE(view.magnifies());
    EXPECT_TRUE(view.follow(host::PointerMoved{{321.5, 100}}));
    EXPECT_FALSE(view.follow(host::WheelTurned{0, 1}));
    const Extent picture = view.drawn(k_window);
    EXPECT_EQ(view.pixel(picture, k_window).x, 80);
    EXPECT_EQ(view.pixel(picture, k_window).y, 25);
    EXPECT_EQ(view.pixel(k_window, k_window).x, 321) << "of a picture in the window's pixels";
    view.follow(host::PointerMoved{{-0.5, 359.9}});
    EXPECT_EQ(view.pixel(picture, k_window).x, -1) << "outside of the window";
    EXPECT_EQ(view.pixel(picture, k_window).y, 89) << "the last row";
    view.toggle_magnifier();
    EXPECT_FALSE(view.magnifies());
}

TEST(PictureView, marks_are_off_at_first) {
    PictureView view = scaled("1");
    EXPECT_FALSE(view.shows_marks());
    view.toggle_marks();
    EXPECT_TRUE(view.shows_marks());
    view.toggle_marks();
    EXPECT_FALSE(view.shows_marks());
}

TEST(PictureView, a_number_key_shows_a_picture_and_then_the_scene) {
    PictureView view = scaled("1");
    view.choose(2);
    EXPECT_EQ(view.large(), 1U);
    view.choose(3);
    EXPECT_EQ(view.large(), 2U);
    view.choose(3);
    EXPECT_EQ(view.large(), std::nullopt);
    view.show_large(4);
    view.choose(0);
    EXPECT_EQ(view.large(), std::nullopt);
    view.choose(0);
    EXPECT_EQ(view.large(), std::nullopt) << "0 is never a picture";
}

} // namespace tidemark::window::picture_view_test
