// Files that name each other in their channels, as the VS Code extension has it.
#include "scene_support.hpp"
#include "support/naming.hpp"

#include <gmock/gmock.h>

namespace tidemark::scene::buffers_by_file_test {

using testing::ElementsAre;
using testing::SizeIs;

using BuffersByFile = SceneFolder;

std::string reads(std::string_view source) {
    return "#iChannel0 \"" + std::string(source) + "\"\n" + k_main_image;
}

TEST_F(BuffersByFile, a_file_that_is_read_is_a_buffer_drawn_before) {
    save("a.glsl", "#iChannel0 \"sub/b.glsl\"\n#iChannel1 \"file://c.frag\"\n#iChannel2 \"sub/../c.frag\"\n" +
                       k_main_image);
    save("sub/b.glsl", "#include \"d.glsl\"\n" + reads("../c.frag"));
    save("sub/d.glsl", "#iUniform float k = 1.0\n");
    save("c.frag", reads("t.png"));
    const Scene scene = load("a.glsl");
    EXPECT_THAT(names_of(scene), ElementsAre("c.frag", "b.glsl", "Image"));
    EXPECT_EQ(input(scene, 1, 0), ChannelInput(PassOutput{0}));
    EXPECT_EQ(input(scene, 2, 0), ChannelInput(PassOutput{1}));
    EXPECT_EQ(input(scene, 2, 1), ChannelInput(PassOutput{0}));
    EXPECT_EQ(input(scene, 2, 2), ChannelInput(PassOutput{0}));
    EXPECT_EQ(scene.passes[2].channels[0].sampling, Sampling{}) << "repeat, as the extension has it";
    EXPECT_THAT(scene.knobs, SizeIs(1));
    EXPECT_THAT(scene.files, ElementsAre(path() / "a.glsl", path() / "sub/b.glsl", path() / "sub/d.glsl",
                                         path() / "c.frag", path() / "t.png"));
}

TEST_F(BuffersByFile, a_file_that_reads_itself_is_a_buffer_and_shown) {
    for (const std::string source : {"self", "file://self", "a.glsl", "./a.glsl"}) {
        save("a.glsl", reads(source));
        const Scene scene = load("a.glsl");
        EXPECT_THAT(names_of(scene), ElementsAre("a.glsl", "Image"));
        EXPECT_EQ(scene.passes[0].kind, PassKind::buffer);
        EXPECT_EQ(input(scene, 0, 0), ChannelInput(PassOutput{0}));
        EXPECT_EQ(input(scene, 1, 0), ChannelInput(PassOutput{0}));
        EXPECT_EQ(input(scene, 1, 1), ChannelInput(Unbound{}));
        EXPECT_EQ(scene.passes[1].channels[0].sampling.magnify, Filter::nearest);
        EXPECT_EQ(scene.image().text.lines().locate(1), SourceLocation{}) << "a text of our own making";
    }
}

TEST_F(BuffersByFile, a_buffer_may_read_itself) {
    save("a.glsl", reads("b.glsl"));
    save("b.glsl", reads("self"));
    const Scene scene = load("a.glsl");
    EXPECT_THAT(names_of(scene), ElementsAre("b.glsl", "Image"));
    EXPECT_EQ(input(scene, 0, 0), ChannelInput(PassOutput{0}));
    EXPECT_EQ(input(scene, 1, 0), ChannelInput(PassOutput{0}));
}

TEST_F(BuffersByFile, a_cycle_is_named) {
    save("a.glsl", reads("b.glsl"));
    save("b.glsl", "\n" + reads("c.glsl"));
    save("c.glsl", "\n\n" + reads("b.glsl"));
    EXPECT_THAT(refusal("a.glsl"),
                naming("c.glsl:3: error:", "'b.glsl'", "'c.glsl'", "cannot be put in an order"));
    save("c.glsl", reads("a.glsl"));
    EXPECT_THAT(refusal("a.glsl"),
                testing::StartsWith("c.glsl:1: error: 'a.glsl' reads 'b.glsl' reads 'c.glsl' reads "
                                    "'a.glsl': "));
}

TEST_F(BuffersByFile, in_a_folder_are_added_to_the_passes) {
    save("image.glsl", reads("blur.glsl"));
    save("buffer_a.glsl", reads("blur.glsl"));
    save("blur.glsl", "#iChannel1 \"image.glsl\"\n" + reads("buffer_a.glsl"));
    const Scene scene = load();
    EXPECT_THAT(names_of(scene), ElementsAre("blur.glsl", "Buffer A", "image.glsl", "Image"));
    EXPECT_EQ(input(scene, 0, 0), ChannelInput(PassOutput{1}));
    EXPECT_EQ(input(scene, 0, 1), ChannelInput(PassOutput{2}));
}

TEST_F(BuffersByFile, of_the_same_name_get_distinct_names) {
    save("a.glsl", "#iChannel1 \"y/b.glsl\"\n" + reads("x/b.glsl"));
    save("x/b.glsl", k_main_image);
    save("y/b.glsl", k_main_image);
    EXPECT_THAT(names_of(load("a.glsl")), ElementsAre("b.glsl", "y/b.glsl", "Image"));
}

TEST_F(BuffersByFile, unreadable_files_are_reported_at_their_directive) {
    save("a.glsl", "\n" + reads("b.glsl"));
    EXPECT_EQ(refusal("a.glsl"), "a.glsl:2: error: cannot read 'b.glsl': no such file");
    save("b.glsl", "// empty");
    EXPECT_THAT(refusal("a.glsl"), naming("'b.glsl'", "is empty"));
    save("b.glsl", "#iUniform float");
    EXPECT_THAT(refusal("a.glsl"),
                testing::StartsWith("b.glsl:1:16: error: expected the name of the uniform"));
}

TEST_F(BuffersByFile, knobs_of_the_same_name_are_one_knob) {
    save("a.glsl", "#iUniform float k = 1.0\n" + reads("b.glsl"));
    save("b.glsl", "#iUniform float k = 2.0\n" + k_main_image);
    const Scene scene = load("a.glsl");
    ASSERT_THAT(scene.knobs, SizeIs(1));
    EXPECT_EQ(scene.knobs[0].value[0], 1.0);
    save("b.glsl", "#iUniform int k = 2\n" + k_main_image);
    EXPECT_THAT(refusal("a.glsl"), naming("b.glsl:1: error:", "knob", "'k'", "a.glsl:1: note:"));
}

TEST_F(BuffersByFile, chains_have_a_limit) {
    for (int i = 0; i < 100; ++i)
        save(std::to_string(i) + ".glsl", reads(std::to_string(i + 1) + ".glsl"));
    EXPECT_THAT(refusal("0.glsl"), naming("63.glsl:1: error:", "more than 64"));
}

TEST_F(BuffersByFile, the_faces_of_a_cubemap_by_a_wildcard) {
    const auto save_all = [&](std::initializer_list<const char*> suffixes) {
        for (const char* suffix : suffixes)
            save(std::string("sky_") + suffix + ".png", "");
    };
    const std::string type = "#iChannel0::Type \"CubeMap\"\n";
    save("a.glsl", type + reads("sky_*.png"));
    save_all({"posx", "negx", "posy", "negy", "posz"});
    EXPECT_THAT(refusal("a.glsl"), naming("a.glsl:2: error:", "six files", "'sky_*.png'"));
    save_all({"negz"});
    const auto faces_of = [&] { return std::get<Cubemap>(input(load("a.glsl"), 0, 0)).files; };
    EXPECT_THAT(faces_of(),
                ElementsAre(path() / "sky_posx.png", path() / "sky_negx.png", path() / "sky_posy.png",
                            path() / "sky_negy.png", path() / "sky_posz.png", path() / "sky_negz.png"));
    save_all({"e", "w", "u", "d", "n", "s"});
    EXPECT_EQ(faces_of().front(), path() / "sky_e.png");
    save("a.glsl", type + reads("sky_{}.png"));
    EXPECT_EQ(faces_of().back(), path() / "sky_s.png");
    save("a.glsl", type + reads("cross.png"));
    EXPECT_THAT(faces_of(), ElementsAre(path() / "cross.png"));
}

TEST_F(BuffersByFile, each_file_requests_keyboard_helpers_separately) {
    save("a.glsl", reads("b.glsl"));
    save("b.glsl", "#iKeyboard\n" + k_main_image);
    const Scene scene = load("a.glsl");
    EXPECT_TRUE(scene.passes[0].keyboard_helpers);
    EXPECT_FALSE(scene.passes[1].keyboard_helpers);
}

} // namespace tidemark::scene::buffers_by_file_test
