#ifdef TIDEMARK_WINDOW
#include "window/glfw.hpp"

#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

namespace tidemark::window::window_keys_test {

using namespace host;

int code(int glfw_key, const char* name = nullptr) {
    return js_key_code(key_from_glfw(glfw_key, name));
}

TEST(WindowKeys, have_the_codes_of_javascript) {
    EXPECT_EQ(code(GLFW_KEY_LEFT), 37);
    EXPECT_EQ(code(GLFW_KEY_UP), 38);
    EXPECT_EQ(code(GLFW_KEY_RIGHT), 39);
    EXPECT_EQ(code(GLFW_KEY_DOWN), 40);
    EXPECT_EQ(code(GLFW_KEY_LEFT_SHIFT), 16);
    EXPECT_EQ(code(GLFW_KEY_RIGHT_CONTROL), 17);
    EXPECT_EQ(code(GLFW_KEY_LEFT_ALT), 18);
    EXPECT_EQ(code(GLFW_KEY_SPACE), 32);
    EXPECT_EQ(code(GLFW_KEY_ENTER), 13);
    EXPECT_EQ(code(GLFW_KEY_KP_ENTER), 13);
    EXPECT_EQ(code(GLFW_KEY_A), 65);
    EXPECT_EQ(code(GLFW_KEY_Z), 90);
    EXPECT_EQ(code(GLFW_KEY_0), 48);
    EXPECT_EQ(code(GLFW_KEY_9), 57);
    EXPECT_EQ(code(GLFW_KEY_KP_0), 96);
    EXPECT_EQ(code(GLFW_KEY_KP_9), 105);
    EXPECT_EQ(code(GLFW_KEY_F1), 112);
    EXPECT_EQ(code(GLFW_KEY_F12), 123);
    EXPECT_EQ(code(GLFW_KEY_SEMICOLON), 186);
    EXPECT_EQ(code(GLFW_KEY_APOSTROPHE), 222);
}

TEST(WindowKeys, letters_follow_the_layout) {
    EXPECT_EQ(code(GLFW_KEY_Y, "z"), 90);
    EXPECT_EQ(code(GLFW_KEY_Q, "A"), 65);
    EXPECT_EQ(code(GLFW_KEY_SEMICOLON, "m"), 77);
}

TEST(WindowKeys, other_keys_follow_their_place) {
    EXPECT_EQ(code(GLFW_KEY_A, "ф"), 65);
    EXPECT_EQ(code(GLFW_KEY_1, "&"), 49);
    EXPECT_EQ(code(GLFW_KEY_SEMICOLON, "ö"), 186);
    EXPECT_EQ(code(GLFW_KEY_S, ""), 83);
}

TEST(WindowKeys, keypad_digits_are_not_digits) {
    EXPECT_EQ(code(GLFW_KEY_KP_7, "7"), 103);
}

TEST(WindowKeys, every_key_of_glfw_but_f25_has_a_code_in_shadertoys_texture) {
    for (const int first : {GLFW_KEY_A, GLFW_KEY_0, GLFW_KEY_KP_0, GLFW_KEY_F1, GLFW_KEY_ESCAPE})
        EXPECT_NE(code(first), 0) << first;
    for (int key = GLFW_KEY_ESCAPE; key <= GLFW_KEY_END; ++key)
        EXPECT_NE(code(key), 0) << key;
    for (int key = GLFW_KEY_CAPS_LOCK; key <= GLFW_KEY_PAUSE; ++key)
        EXPECT_NE(code(key), 0) << key;
    for (int key = GLFW_KEY_KP_0; key <= GLFW_KEY_KP_EQUAL; ++key)
        EXPECT_NE(code(key), 0) << key;
    for (int key = GLFW_KEY_LEFT_SHIFT; key <= GLFW_KEY_LAST; ++key)
        EXPECT_NE(code(key), 0) << key;
    for (int key = 0; key <= GLFW_KEY_LAST; ++key)
        EXPECT_LT(code(key), 256) << key;
    EXPECT_EQ(code(GLFW_KEY_UNKNOWN), 0);
}

} // namespace tidemark::window::window_keys_test
#endif
