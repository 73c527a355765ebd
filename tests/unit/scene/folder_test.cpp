// Scene folders by the names of their files, and the bounds of what a scene may read.
#include "scene/load_scene.hpp"
#include "scene_support.hpp"
#include "support/naming.hpp"

#include <gmock/gmock.h>

namespace tidemark::scene::folder_test {

using testing::ElementsAre;
using testing::IsEmpty;

using Folder = SceneFolder;

TEST_F(Folder, every_pass_by_our_names) {
    save("image.glsl", "#iChannel0 \"buffer_b\"\n#iChannel1 \"Cube A\"\n" + k_main_image);
    save("buffer_a.glsl",
         "#iChannel0 \"self\"\n#iChannel1 \"buffer_b\"\n#iChannel2 \"keyboard\"\n" + k_main_image);
    save("buffer_b.glsl", "#iChannel0 \"Buffer A\"\n" + k_main_image);
    save("common.glsl", "#iUniform float k = 1.0\nint c;\n");
    save("cube_a.glsl", "void mainCubemap() {}\n");
    save("sound.glsl", "vec2 mainSound(float t) {}\n");
    save("readme.md", "");
    const Scene scene = load();
    EXPECT_THAT(names_of(scene), ElementsAre("Buffer A", "Buffer B", "Cube A", "Image", "Sound"));
    EXPECT_EQ(scene.common.text(), "\nint c;\n\n");
    ASSERT_EQ(scene.knobs.size(), 1u);
    EXPECT_EQ(input(scene, 0, 0), ChannelInput(PassOutput{0}));
    EXPECT_EQ(input(scene, 0, 1), ChannelInput(PassOutput{1}));
    EXPECT_EQ(input(scene, 0, 2), ChannelInput(Keyboard{}));
    EXPECT_EQ(input(scene, 1, 0), ChannelInput(PassOutput{0}));
    EXPECT_EQ(input(scene, 3, 0), ChannelInput(PassOutput{1}));
    EXPECT_EQ(input(scene, 3, 1), ChannelInput(PassOutput{2}));
    EXPECT_EQ(scene.passes[3].channels[0].sampling, Sampling{}) << "as the extension samples what it names";
    EXPECT_EQ(scene.name(), path().filename());
    EXPECT_THAT(scene.warnings, IsEmpty());
}

TEST_F(Folder, files_of_a_scene_are_recognised_by_name) {
    for (const char* name : {"image.glsl", "Buffer B.frag", "common.glsl", "Common.glsl", "scene.json",
                             "lib.glsl", "image.png", "notes.txt", ".image.glsl.swp"})
        save(name, "");
    std::vector<std::string> names;
    for (const auto& file : scene_files_in(path()))
        names.push_back(file.filename().string());
    EXPECT_THAT(names,
                ElementsAre("Buffer B.frag", "Common.glsl", "common.glsl", "image.glsl", "scene.json"));
    EXPECT_THAT(scene_files_in(path() / "missing"), IsEmpty());
}

TEST_F(Folder, an_unread_pass_is_warned_about) {
    save("Buffer A.glsl", "#iChannel0 \"self\"\n" + k_main_image);
    save("image.glsl", k_main_image);
    const Scene scene = load();
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_THAT(plain(to_string(scene.warnings[0])),
                naming("Buffer A.glsl: warning:", "'Buffer A'", "#iChannel0"));
}

TEST_F(Folder, other_file_names_of_passes_are_recognised) {
    save("Buffer A.glsl", k_main_image);
    save("BufB.frag", k_main_image);
    save("buf_c.fs", k_main_image);
    save("BUFFER-D.txt", k_main_image);
    save("Cubemap A.glsl", "void mainCubemap() {}\n");
    save("Image.frag", k_main_image);
    save("Common.glsl", "");
    save("notes.txt", "");
    EXPECT_THAT(names_of(load()),
                ElementsAre("Buffer A", "Buffer B", "Buffer C", "Buffer D", "Cube A", "Image"));
}

TEST_F(Folder, two_files_for_one_pass_are_an_error) {
    save("image.glsl", k_main_image);
    save("Image.frag", k_main_image);
    EXPECT_EQ(refusal(),
              "tidemark: error: 'Image.frag' and 'image.glsl' are both the pass 'Image': rename one");
}

TEST_F(Folder, missing_and_empty_passes_are_errors) {
    save("image.glsl", "\n#iChannel0 \"buffer_b\"\n" + k_main_image);
    EXPECT_THAT(refusal(), naming("image.glsl:2: error:", "'Buffer B'", "'buffer_b.glsl'", "blur.glsl"));
    save("buffer_b.glsl", "// nothing yet\n");
    EXPECT_THAT(refusal(), naming("'buffer_b.glsl'", "is empty"));
}

TEST_F(Folder, common_included_by_a_pass_is_pasted_once) {
    save("common.glsl", "int c;\n");
    save("buffer_a.glsl", "#include \"common.glsl\"\n" + k_main_image);
    save("image.glsl", k_main_image);
    const Scene scene = load();
    EXPECT_EQ(scene.common.text(), "");
    EXPECT_EQ(scene.passes[0].text.text(), "int c;\n\n" + k_main_image);
    EXPECT_EQ(scene.passes[1].text.text(), "int c;\n\n" + k_main_image);
}

TEST_F(Folder, an_image_that_a_buffer_reads_becomes_a_buffer) {
    save("buffer_a.glsl", "#iChannel0 \"image\"\n" + k_main_image);
    save("image.glsl", k_main_image);
    const Scene scene = load();
    EXPECT_THAT(names_of(scene), ElementsAre("Buffer A", "image.glsl", "Image"));
    EXPECT_EQ(input(scene, 0, 0), ChannelInput(PassOutput{1}));
    EXPECT_EQ(input(scene, 2, 0), ChannelInput(PassOutput{1}));
}

TEST_F(Folder, with_a_project_file_uses_its_inputs) {
    save("scene.json", R"({"renderpass":[
        {"type":"image","code":{"file":"picture.glsl"},"inputs":[
            {"channel":0,"src":"own.png"},{"channel":1,"src":"Buffer A","sampler":{"filter":"nearest"}}]},
        {"type":"buffer","inputs":[{"channel":2,"ctype":"texture","id":30}]},
        {"type":"common","code":"int inline_code;"}]})");
    save("picture.glsl", "#iUniform float k = 1.0\n" + k_main_image);
    save("buffer_a.glsl", "#include \"part.glsl\"\n#iChannel3 \"other.png\"\n" + k_main_image);
    save("buffer_b.glsl", k_main_image);
    save("part.glsl", "int p;\n");
    save("own.png", "");
    const Scene scene = load();
    EXPECT_THAT(names_of(scene), ElementsAre("Buffer A", "Image"));
    EXPECT_EQ(scene.common.text(), "int inline_code;\n");
    EXPECT_EQ(scene.common.lines().locate(1).file, (path() / "scene.json:Common").string());
    EXPECT_EQ(scene.passes[0].text.text(), "int p;\n\n\n" + k_main_image);
    EXPECT_EQ(scene.passes[0].text.lines().locate(4).file, path() / "buffer_a.glsl");
    EXPECT_EQ(input(scene, 0, 0), ChannelInput(Unbound{}));
    EXPECT_EQ(input(scene, 0, 2), ChannelInput(Noise{NoiseKind::rgba_256}));
    EXPECT_EQ(input(scene, 0, 3), ChannelInput(Picture{path() / "other.png"}));
    EXPECT_EQ(input(scene, 1, 0), ChannelInput(Picture{path() / "own.png"}));
    EXPECT_EQ(input(scene, 1, 1), ChannelInput(PassOutput{0}));
    EXPECT_EQ(scene.passes[1].channels[1].sampling.magnify, Filter::nearest);
    EXPECT_EQ(scene.knobs.size(), 1u);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_THAT(plain(to_string(scene.warnings[0])),
                naming("buffer_b.glsl: warning:", "'scene.json'", "is ignored"));
    EXPECT_EQ(load("scene.json").passes.size(), 2u) << "its scene.json means the folder";
}

TEST_F(Folder, a_project_with_missing_code_is_an_error) {
    save("scene.json", R"({"renderpass":[{"type":"image"}]})");
    EXPECT_EQ(refusal(), "tidemark: error: cannot read 'image.glsl': no such file");
}

TEST_F(Folder, files_outside_the_folder_are_refused) {
    save("s/image.glsl", "\n#iChannel0 \"../secret.png\"\n" + k_main_image);
    EXPECT_THAT(refusal("s"), naming("s/image.glsl:2: error:", "'secret.png'", "lies outside", "'s'"));
    save("s/image.glsl", "\n\n#include \"../secret.glsl\"\n" + k_main_image);
    save("secret.glsl", "");
    EXPECT_THAT(refusal("s"), testing::StartsWith("s/image.glsl:3: error: 'secret.glsl' lies outside"));
    save("s/image.glsl", "#iChannel0 \"../secret.glsl\"\n" + k_main_image);
    EXPECT_THAT(refusal("s"), testing::StartsWith("s/image.glsl:1: error: 'secret.glsl' lies outside"));
    save("s/image.glsl", "#iChannel0 \"/etc/passwd\"\n" + k_main_image);
    EXPECT_THAT(refusal("s"), testing::StartsWith("s/image.glsl:1: error: '/etc/passwd' lies outside"));
    save("s/scene.json", R"({"renderpass":[{"type":"image","code":{"file":"../secret.glsl"}}]})");
    EXPECT_THAT(refusal("s"), testing::StartsWith("tidemark: error: 'secret.glsl' lies outside"));
    save("s/scene.json",
         R"({"renderpass":[{"type":"image","code":"mainImage","inputs":[{"channel":0,"src":"../a.png"}]}]})");
    EXPECT_THAT(refusal("s"), testing::StartsWith("s/scene.json: error: 'a.png' lies outside"));
}

TEST_F(Folder, links_out_of_the_folder_are_refused) {
    save("s/image.glsl", "#include \"l.glsl\"\n" + k_main_image);
    save("secret.glsl", "int secret;\n");
    std::filesystem::create_symlink("../secret.glsl", path() / "s/l.glsl");
    EXPECT_THAT(refusal("s"), testing::StartsWith("s/image.glsl:1: error: 's/l.glsl' lies outside"));
    LoadOptions options;
    options.allow_outside = true;
    EXPECT_TRUE(load_scene(path() / "s", options));
    std::filesystem::create_symlink("/", path() / "textures");
    save("s/image.glsl", "#iChannel0 \"../textures/etc/passwd\"\n" + k_main_image);
    EXPECT_THAT(refusal("s"),
                testing::StartsWith("s/image.glsl:1: error: 'textures/etc/passwd' lies outside"));
}

TEST_F(Folder, sibling_folders_textures_and_lib_are_allowed_and_a_scene_may_be_a_link) {
    save("textures/t.png", "");
    save("lib/l.glsl", "int l;\n");
    save("s/a.glsl", "#include \"../lib/l.glsl\"\n#iChannel0 \"../textures/t.png\"\n" + k_main_image);
    EXPECT_EQ(input(load("s/a.glsl"), 0, 0), ChannelInput(Picture{path() / "textures/t.png"}));
    save("elsewhere/b.glsl", k_main_image);
    std::filesystem::create_symlink("../elsewhere/b.glsl", path() / "s/b.glsl");
    EXPECT_EQ(refusal("s/b.glsl"), "it was loaded");
}

} // namespace tidemark::scene::folder_test
