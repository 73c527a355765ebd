// How editors are told a place.
#include "window/overlay.hpp"

#include <gmock/gmock.h>

namespace tidemark::window::editor_test {

using testing::ElementsAre;

const SourceLocation k_place{"a b.glsl", 12, 5};

TEST(Editor, command_has_the_place_in_the_editors_syntax) {
    EXPECT_THAT(editor_words("code --wait", k_place),
                ElementsAre("code", "--wait", "--goto", "a b.glsl:12:5"));
    EXPECT_THAT(editor_words("/usr/bin/kate", k_place),
                ElementsAre("/usr/bin/kate", "-l", "12", "-c", "5", "a b.glsl"));
    EXPECT_THAT(editor_words("emacsclient  -n", k_place),
                ElementsAre("emacsclient", "-n", "+12", "a b.glsl"));
    EXPECT_THAT(editor_words("vim", k_place),
                ElementsAre("x-terminal-emulator", "-e", "vim", "+12", "a b.glsl"));
}

TEST(Editor, command_uses_line_1_for_an_error_without_a_line) {
    EXPECT_THAT(editor_words("subl", {"a.glsl", 0, 0}), ElementsAre("subl", "a.glsl:1:1"));
}

TEST(Editor, blank_setting_gives_no_command) {
    EXPECT_THAT(editor_words("  ", k_place), ElementsAre());
}

} // namespace tidemark::window::editor_test
