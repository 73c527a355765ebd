// Scenes from files, and what the command line changes in them.
#include "scene/load_scene.hpp"
#include "scene/scene.hpp"
#include "support/naming.hpp"
#include "support/temporary_folder.hpp"

#include <gmock/gmock.h>

namespace tidemark::scene::scene_test {

using testing::ElementsAre;

const std::string k_main_image = "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n";

std::string refusal(const std::filesystem::path& path) {
    const auto scene = load_scene(path);
    if (scene)
        return "it was loaded";
    EXPECT_EQ(scene.error().code, ErrorCode::load);
    return to_string(scene.error());
}

Scene load(const std::filesystem::path& path) {
    auto scene = load_scene(path);
    EXPECT_TRUE(scene) << to_string(scene.error());
    return scene ? *std::move(scene) : Scene{};
}

TEST(LoadScene, a_bare_file) {
    const TemporaryFolder folder;
    save_in_place(folder / "waves.glsl", k_main_image);
    const Scene scene = load(folder / "waves.glsl");
    EXPECT_EQ(scene.name(), "waves");
    EXPECT_EQ(scene.file, folder / "waves.glsl");
    ASSERT_EQ(scene.passes.size(), 1u);
    EXPECT_EQ(&scene.image(), &scene.passes.front());
    EXPECT_EQ(scene.image().name, "Image");
    EXPECT_EQ(scene.image().text.text(), k_main_image);
    EXPECT_TRUE(scene.knobs.empty());
    EXPECT_THAT(scene.files, ElementsAre(folder / "waves.glsl"));
}

TEST(LoadScene, with_includes_directives_and_pictures) {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "lib");
    save_in_place(folder / "a.glsl", "#include \"lib/b.glsl\"\n#iChannel1 \"lib/t.png\"\n" + k_main_image);
    save_in_place(folder / "lib/b.glsl",
                  "#iUniform float k = 2.0\n#iChannel0 \"t.png\"\n#iChannel2 \"u.png\"\n");
    const Scene scene = load(folder / "a.glsl");
    ASSERT_EQ(scene.knobs.size(), 1u);
    EXPECT_EQ(scene.knobs[0].name, "k");
    EXPECT_EQ(scene.image().channels[0].input, ChannelInput(Picture{folder / "lib/t.png"}));
    EXPECT_EQ(scene.image().channels[1].input, ChannelInput(Picture{folder / "lib/t.png"}));
    EXPECT_EQ(scene.image().channels[3].input, ChannelInput(Noise{}));
    EXPECT_THAT(scene.files, ElementsAre(folder / "a.glsl", folder / "lib/b.glsl", folder / "lib/t.png",
                                         folder / "lib/u.png"));
}

TEST(LoadScene, other_files_are_refused_with_the_reason) {
    const TemporaryFolder folder;
    const std::string path = folder / "a.glsl";
    EXPECT_EQ(refusal(path), "tidemark: error: cannot read '" + path + "': no such file");
    EXPECT_EQ(refusal(folder.path()),
              "tidemark: error: '" + folder.path().string() +
                  "' has no image.glsl: a scene folder holds image.glsl and, as needed, buffer_a.glsl to "
                  "buffer_d.glsl, common.glsl, cube_a.glsl and sound.glsl");
    save_in_place(path, std::string_view("\x7f"
                                         "ELF\0\0",
                                         6));
    EXPECT_EQ(refusal(path), "tidemark: error: '" + path + "' is a binary file, not shader text");
}

TEST(LoadScene, an_empty_file_is_refused) {
    const TemporaryFolder folder;
    const std::string path = folder / "a.glsl";
    for (const char* text : {"", "\n \t\r\n", "\xEF\xBB\xBF", "// mainImage", "/* mainImage"}) {
        save_in_place(path, text);
        EXPECT_EQ(refusal(path), "tidemark: error: '" + path + "' is empty: a scene defines mainImage");
    }
}

TEST(LoadScene, without_main_image) {
    const TemporaryFolder folder;
    const std::string path = folder / "a.glsl";
    for (const char* text :
         {"void remain() {}", "// void mainImage(out vec4 c, in vec2 p)\nint x;", "int mainImages;"}) {
        save_in_place(path, text);
        EXPECT_EQ(refusal(path), "tidemark: error: '" + path +
                                     "' has no mainImage: a scene defines void mainImage(out vec4 fragColor, "
                                     "in vec2 fragCoord)");
    }
}

TEST(LoadScene, main_image_may_be_included_or_a_macro) {
    const TemporaryFolder folder;
    save_in_place(folder / "a.glsl", "#include \"b.glsl\"\n");
    save_in_place(folder / "b.glsl", k_main_image);
    EXPECT_EQ(refusal(folder / "a.glsl"), "it was loaded");
    save_in_place(folder / "a.glsl", "#define mainImage(O,U) void f(out vec4 O, vec2 U)\n");
    EXPECT_EQ(refusal(folder / "a.glsl"), "it was loaded");
}

TEST(LoadScene, errors_of_directives_and_includes_have_their_place) {
    const TemporaryFolder folder;
    const std::string path = folder / "a.glsl";
    const std::string included = folder / "b.glsl";
    save_in_place(path, "\n#include \"b.glsl\"\n" + k_main_image);
    save_in_place(included, "\n\n#iUniform float k");
    EXPECT_EQ(refusal(path), included + ":3: error: the knob 'k' needs a default (= VALUE) or a range (in { "
                                        "LOW, HIGH })");
    save_in_place(included, "#include \"a.glsl\"");
    EXPECT_EQ(refusal(path),
              included + ":1: error: 'a.glsl' includes itself\n" + path + ":2: note: included from here");
}

TEST(SplitSetting, at_the_first_equals_sign) {
    const auto split = split_setting("a=b=c", "--set");
    ASSERT_TRUE(split);
    EXPECT_EQ(split->first, "a");
    EXPECT_EQ(split->second, "b=c");
    EXPECT_EQ(split_setting("a=", "--set")->second, "");
    for (const std::string setting : {"", "a", "=b"}) {
        const auto refused = split_setting(setting, "--set");
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::usage);
        EXPECT_EQ(refused.error().message, "--set " + setting + ": give it as NAME=VALUE");
    }
}

class Overrides : public testing::Test {
protected:
    Overrides() {
        save_in_place(folder_ / "a.glsl",
                      "#iUniform float k = 1.0\n#iChannel0 \"t.png\"\n#iChannel0::WrapMode \"Clamp\"\n" +
                          k_main_image);
        scene = load(folder_ / "a.glsl");
    }
    static std::string message(const Result<void>& done) {
        EXPECT_TRUE(done || done.error().code == ErrorCode::usage);
        return done ? "" : done.error().message;
    }

    Scene scene;

private:
    TemporaryFolder folder_;
};

TEST_F(Overrides, a_knob_gets_its_value_and_keeps_its_default) {
    EXPECT_EQ(message(override_knob(scene, "k=2.5")), "");
    EXPECT_EQ(scene.knobs[0].value[0], 2.5);
    EXPECT_EQ(scene.knobs[0].initial[0], 1);
    EXPECT_THAT(message(override_knob(scene, "k")), naming("--set k"));
    EXPECT_EQ(message(override_knob(scene, "j=1")), "the scene has no knob 'j': did you mean 'k'?");
    EXPECT_THAT(message(override_knob(scene, "k=x")), naming("'x'", "(float)", "a number"));
    EXPECT_EQ(scene.knobs[0].value[0], 2.5);
}

TEST_F(Overrides, a_channel_of_another_pass_is_selected_by_its_name) {
    Pass buffer;
    buffer.kind = PassKind::buffer;
    buffer.name = "Buffer A";
    scene.passes.insert(scene.passes.begin(), buffer);
    EXPECT_EQ(message(override_channel(scene, "Buffer A:1=a:b.png")), "");
    EXPECT_EQ(scene.passes[0].channels[1].input, ChannelInput(Picture{"a:b.png"}));
    EXPECT_EQ(scene.image().channels[1].input, ChannelInput(Noise{}));
    EXPECT_EQ(message(override_channel(scene, scene.image().name + ":1=none")), "");
    EXPECT_EQ(scene.image().channels[1].input, ChannelInput(Unbound{}));
    EXPECT_THAT(message(override_channel(scene, "Buffer B:0=none")), naming("--channel", "no such pass"));
    EXPECT_EQ(message(override_channel(scene, "Buffer A:x=none")),
              "--channel Buffer A:x=none: give it as N=FILE, N=noise or N=none, N from 0 to 9");
}

TEST_F(Overrides, a_value_out_of_range_is_accepted_with_a_warning) {
    scene.knobs[0].range = KnobRange{{0}, {2}};
    EXPECT_EQ(message(override_knob(scene, "k=2")), "");
    EXPECT_TRUE(scene.warnings.empty());
    EXPECT_EQ(message(override_knob(scene, "k=-5")), "");
    EXPECT_EQ(scene.knobs[0].value[0], -5);
    ASSERT_EQ(scene.warnings.size(), 1U);
    EXPECT_EQ(scene.warnings[0].message, "--set k=-5: k has the range 0 to 2; the value is used anyway");
    EXPECT_EQ(scene.warnings[0].where.line, 1);
}

TEST_F(Overrides, a_channel_reads_the_given_input) {
    EXPECT_EQ(message(override_channel(scene, "0=noise")), "");
    EXPECT_EQ(scene.image().channels[0].input, ChannelInput(Noise{}));
    EXPECT_EQ(scene.image().channels[0].sampling, k_texture_sampling);
    EXPECT_EQ(scene.image().channels[0].where, SourceLocation{});
    EXPECT_EQ(message(override_channel(scene, "1=none")), "");
    EXPECT_EQ(scene.image().channels[1].input, ChannelInput(Unbound{}));
    EXPECT_EQ(message(override_channel(scene, "3=a=b.png")), "");
    EXPECT_EQ(scene.image().channels[3].input, ChannelInput(Picture{"a=b.png"}));
    EXPECT_EQ(scene.files.back(), "a=b.png");
    EXPECT_EQ(message(override_channel(scene, "0=/else/a.mp3")), "");
    EXPECT_EQ(scene.image().channels[0].input, ChannelInput(Music{"/else/a.mp3"}));
    EXPECT_EQ(message(override_channel(scene, "0=keyboard")), "");
    EXPECT_EQ(scene.image().channels[0].input, ChannelInput(Keyboard{}));
    EXPECT_THAT(message(override_channel(scene, "0=blur.glsl")),
                naming("--channel 0=blur.glsl", "'blur.glsl'", "is a pass"));
}

TEST_F(Overrides, invalid_channels_are_refused) {
    for (const std::string setting : {"10=noise", "-1=noise", "00=noise", "x=noise", "0="})
        EXPECT_EQ(message(override_channel(scene, setting)),
                  "--channel " + setting + ": give it as N=FILE, N=noise or N=none, N from 0 to 9");
    EXPECT_EQ(message(override_channel(scene, "noise")), "--channel noise: give it as 0=noise");
}

} // namespace tidemark::scene::scene_test
