// ShaderToy's JSON in all its forms becomes a Scene.
#include "scene/load_scene.hpp"
#include "scene/scene.hpp"
#include "scene_support.hpp"
#include "support/naming.hpp"
#include "support/temporary_folder.hpp"

#include <gmock/gmock.h>

namespace tidemark::scene::json_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Json : public testing::Test {
protected:
    Result<Scene> load(std::string_view json, const LoadOptions& options = {}) {
        save_in_place(folder_ / "x.json", json);
        return load_scene(folder_ / "x.json", options);
    }

    /// The one line of the error, the folder's name left out.
    std::string error_of(std::string_view json) {
        const auto scene = load(json);
        return scene ? "loaded" : without_folder(to_string(scene.error()));
    }

    std::string without_folder(std::string text) const {
        const std::string folder = folder_.path().string() + "/";
        for (size_t at; (at = text.find(folder)) != std::string::npos;)
            text.erase(at, folder.size());
        return text;
    }

    std::vector<std::string> warnings_of(const Scene& scene) const {
        std::vector<std::string> lines;
        for (const Diagnostic& warning : scene.warnings)
            lines.push_back(without_folder(to_string(warning)));
        return lines;
    }

    TemporaryFolder folder_;
};

/// A project of the given passes, as the API wraps it.
std::string project(std::string_view passes) {
    return R"({"Shader":{"ver":"0.1","info":{"id":"x"},"renderpass":[)" + std::string(passes) + "]}}";
}

constexpr const char* k_image =
    R"({"inputs":[],"outputs":[{"id":37,"channel":0}],"type":"image","name":"Image","code":"void mainImage(out vec4 c,in vec2 p){c=vec4(1);}"})";

std::string image_with(std::string_view inputs) {
    return R"({"type":"image","name":"","code":"void mainImage(){}","outputs":[],"inputs":[)" +
           std::string(inputs) + "]}";
}

std::string buffer(std::string_view name, std::string_view id, std::string_view inputs = "") {
    return R"({"type":"buffer","name":")" + std::string(name) +
           R"(","code":"void mainImage(){}","outputs":[{"channel":0,"id":)" + std::string(id) +
           R"(}],"inputs":[)" + std::string(inputs) + "]}";
}

TEST_F(Json, every_wrapping_gives_the_same_project) {
    const std::string bare = R"({"ver":"0.1","info":{},"renderpass":[)" + std::string(k_image) + "]}";
    for (const std::string& json :
         {bare, "[" + bare + "]", R"({"Shader":)" + bare + "}", R"({"Shader":[)" + bare + "]}",
          R"([{"Shader":)" + bare + "}]", R"({"userName":"x","numShaders":1,"shaders":[)" + bare + "]}",
          "[" + std::string(k_image) + "]", "\xEF\xBB\xBF" + bare}) {
        const auto scene = load(json);
        ASSERT_TRUE(scene) << to_string(scene.error()) << json;
        EXPECT_THAT(names_of(*scene), ElementsAre("Image"));
        EXPECT_EQ(scene->image().text.text(), "void mainImage(out vec4 c,in vec2 p){c=vec4(1);}\n");
    }
}

TEST_F(Json, passes_are_found_by_output_and_drawn_in_list_order) {
    const auto scene = load(project(std::string(k_image) + "," + buffer("Buf B", "258") + "," +
                                    buffer("", "\"4dXGR8\"", R"({"channel":1,"ctype":"buffer","id":258})")));
    ASSERT_TRUE(scene) << to_string(scene.error());
    EXPECT_THAT(names_of(*scene), ElementsAre("Buffer B", "Buffer A", "Image"));
    EXPECT_EQ(scene->passes[1].channels[1].input, ChannelInput(PassOutput{0}));
    EXPECT_EQ(scene->passes[1].channels[0].input, ChannelInput(Unbound{}));
}

TEST_F(Json, several_commons_keep_the_order_of_the_list_and_their_line_numbers) {
    const auto scene =
        load(project(std::string(k_image) + R"(,{"type":"common","name":"","code":"int a;\r\nint b;"},)"
                                            R"({"type":"common","name":"","code":"int c;\n"})"));
    ASSERT_TRUE(scene) << to_string(scene.error());
    EXPECT_EQ(scene->common.text(), "int a;\nint b;\nint c;\n\n") << "a line end follows each";
    const std::string file = (folder_ / "x.json").string();
    EXPECT_EQ(scene->common.lines().locate(2), (SourceLocation{file + ":Common", 2, 0}));
    EXPECT_EQ(scene->common.lines().locate(3), (SourceLocation{file + ":Common 2", 1, 0}));
    EXPECT_EQ(scene->image().text.lines().locate(1), (SourceLocation{file + ":Image", 1, 0}));
}

TEST_F(Json, passes_are_sorted_in_drawing_order) {
    const auto scene =
        load(project(R"({"type":"sound","code":"vec2 mainSound(float t){}"},)" + std::string(k_image) +
                     R"(,{"type":"cubemap","code":"mainCubemap"},)" + buffer("Buffer @", "\"odd\"")));
    ASSERT_TRUE(scene) << to_string(scene.error());
    EXPECT_THAT(names_of(*scene), ElementsAre("Buffer A", "Cube A", "Image", "Sound"));
}

TEST_F(Json, inputs_are_found_by_channel_and_buffers_by_either_id) {
    const auto scene = load(
        project(buffer("a", "257") + "," + buffer("b", "\"XsXGR8\"") + "," +
                image_with(R"({"channel":3,"ctype":"buffer","id":257,"src":"/media/previz/buffer00.png"},)"
                           R"({"channel":"0","type":"buffer","id":"258"},)"
                           R"({"channel":1,"ctype":null,"id":null,"src":"/media/previz/buffer01.png"},)"
                           R"({"channel":2,"ctype":"buffer","id":259})")));
    ASSERT_TRUE(scene) << to_string(scene.error());
    const Channels& channels = scene->image().channels;
    EXPECT_EQ(channels[3].input, ChannelInput(PassOutput{0}));
    EXPECT_EQ(channels[0].input, ChannelInput(PassOutput{1}));
    EXPECT_EQ(channels[1].input, ChannelInput(PassOutput{1}));
    EXPECT_EQ(channels[2].input, ChannelInput(Unbound{})) << "no Buffer C here: black";
    EXPECT_THAT(scene->warnings, IsEmpty());
}

TEST_F(Json, an_input_without_a_type_is_identified_by_id_or_file) {
    const auto scene = load(project(image_with(R"({"channel":0,"ctype":null,"id":30},)"
                                               R"({"channel":1,"id":"XdX3Rr"},)"
                                               R"({"channel":2,"id":33,"src":"/presets/tex00.jpg"},)"
                                               R"({"channel":3,"src":"/presets/cube00_0.jpg","id":22})")));
    ASSERT_TRUE(scene) << to_string(scene.error());
    const Channels& channels = scene->image().channels;
    EXPECT_EQ(channels[0].input, ChannelInput(Noise{NoiseKind::rgba_256}));
    EXPECT_EQ(channels[1].input, ChannelInput(Noise{NoiseKind::rgba_volume_32}));
    EXPECT_EQ(channels[2].input, ChannelInput(Keyboard{}));
    EXPECT_EQ(channels[3].input, ChannelInput(StandIn{StandIn::Kind::cubemap, 512, 512, 4}));
    EXPECT_EQ(texture_kind(*scene, channels[3].input), TextureKind::cube);
    EXPECT_EQ(texture_kind(*scene, channels[1].input), TextureKind::volume);
}

TEST_F(Json, a_cube_pass_reads_itself_under_its_malformed_name) {
    const std::string self =
        R"({"channel":0,"ctype":"cubemap","id":41,"src":"/media/a//media/previz/cubemap00.png"})";
    const auto scene = load(
        project(R"({"type":"cubemap","outputs":[{"id":41,"channel":0}],"code":"mainCubemap","inputs":[)" +
                self + "]}," + image_with(self)));
    ASSERT_TRUE(scene) << to_string(scene.error());
    EXPECT_EQ(scene->passes[0].channels[0].input, ChannelInput(PassOutput{0}));
    EXPECT_EQ(scene->passes[1].channels[0].input, ChannelInput(PassOutput{0}));

    const auto without = load(project(image_with(self)));
    ASSERT_TRUE(without);
    EXPECT_EQ(texture_kind(*without, without->image().channels[0].input), TextureKind::cube)
        << "black, but a cube";
}

TEST_F(Json, samplers_may_be_strings_or_missing) {
    const auto scene = load(project(image_with(
        R"({"channel":0,"ctype":"texture","id":30,"sampler":{"filter":"nearest","wrap":"clamp","vflip":"false"}},)"
        R"({"channel":1,"ctype":"texture","id":30},)"
        R"({"channel":2,"ctype":"buffer","id":257,"sampler":{"filter":"mipmap","wrap":"repeat","vflip":true}},)"
        R"({"channel":3,"ctype":"volume","id":39})")));
    ASSERT_TRUE(scene) << to_string(scene.error());
    const Channels& channels = scene->image().channels;
    EXPECT_EQ(channels[0].sampling,
              (Sampling{Filter::nearest, Filter::nearest, Mipmaps::none, Wrap::clamp, false}));
    EXPECT_EQ(channels[1].sampling, k_texture_sampling);
    EXPECT_EQ(channels[2].sampling,
              (Sampling{Filter::linear, Filter::linear, Mipmaps::linear, Wrap::repeat, true}));
    EXPECT_EQ(channels[3].sampling, k_volume_sampling);
}

TEST_F(Json, other_json_is_refused_with_the_reason) {
    EXPECT_THAT(error_of("<html>"), naming("x.json:1:1: error: this is not JSON:"));
    EXPECT_THAT(error_of(""), naming("x.json: error: this is not JSON:", "is empty"));
    EXPECT_THAT(error_of("{\n \"Shader\": {,}}"), naming("x.json:2:13: error: this is not JSON:", "','"));
    EXPECT_THAT(error_of(R"({"Error":"Shader not found"})"), naming("x.json: error:", "Shader not found"));
    EXPECT_THAT(error_of("[]"), naming("x.json: error:", "empty list"));
    EXPECT_THAT(error_of(R"({"Shaders":2,"Results":["a","b"]})"),
                naming("x.json: error:", "no list named renderpass"));
    EXPECT_THAT(error_of("[" + project(k_image) + "," + project(k_image) + "]"),
                naming("x.json: error: this holds 2 projects:"));
    EXPECT_THAT(error_of(R"({"numShaders":2,"shaders":[)" + project(k_image) + "," + project(k_image) + "]}"),
                naming("x.json: error: this holds 2 projects:"));
    EXPECT_THAT(error_of(project("")), naming("x.json: error:", "renderpass"));
    EXPECT_EQ(error_of(project("1")), "x.json: error: pass 1 is not an object");
    EXPECT_EQ(error_of(project(R"({"type":"image","name":"Image"})")),
              "x.json: error: the pass 'Image' has no code");
    EXPECT_THAT(error_of(project(R"({"type":"vr","code":""})")), naming("x.json: error:", "pass 1", "'vr'"));
    EXPECT_THAT(error_of(project(buffer("A", "257"))), naming("x.json: error:", "no Image pass"));
}

TEST_F(Json, a_pass_without_an_entry_point_is_an_error) {
    EXPECT_THAT(error_of(project(R"({"type":"image","code":"int i;"})")), naming("'x.json:Image'"));
    EXPECT_THAT(error_of(project(R"({"type":"image","code":""})")),
                naming("'x.json'", "'Image'", "is empty"));
    EXPECT_TRUE(load(project(R"({"type":"image","code":"void main(void){gl_FragColor=vec4(1);}"})")))
        << "as the oldest ones do";
    EXPECT_TRUE(load(project(std::string(k_image) + R"(,{"type":"sound","code":"broken"})")))
        << "a broken Sound tab is not the picture's business";
}

TEST_F(Json, hostile_texts_are_refused_in_linear_time) {
    EXPECT_EQ(error_of(std::string(1'000'000, '[')),
              "x.json:1: error: this JSON is nested more than 64 deep: it is not a ShaderToy project");
    std::string deep;
    for (int i = 0; i < 100'000; ++i)
        deep += "{\"a\":\n";
    EXPECT_THAT(error_of(deep), naming("x.json:65: error:", "more than 64"));
    std::string wide = "{";
    for (int i = 0; i < 100'000; ++i)
        wide += "\"" + std::to_string(i) + "\":0,";
    EXPECT_THAT(error_of(wide), HasSubstr("has an object with more than 1024 members"));
    EXPECT_THAT(error_of("[" + std::string(4'000'000, ',') + "]"), HasSubstr("has more than 1048576 values"));
}

TEST_F(Json, large_code_is_loaded) {
    std::string code(10'000'000, ' ');
    for (size_t i = 0; i + 1 < code.size(); i += 100)
        code.replace(i, 2, "\\n");
    const auto scene = load(project(R"({"type":"image","code":")" + code + R"(void mainImage(){}"})"));
    ASSERT_TRUE(scene) << to_string(scene.error());
    EXPECT_EQ(scene->image().text.line_count(), 100'001);
    EXPECT_EQ(error_of(std::string(100'000'000, ' ')),
              "tidemark: error: cannot read 'x.json': it is larger than 16 MiB");
}

TEST_F(Json, odd_characters_in_code) {
    const auto scene = load(project(
        R"({"type":"image","code":"\ufeff// \u00e9 \ud83d\ude00 \ud83d \u0000\rvoid mainImage(){}"})"));
    ASSERT_TRUE(scene) << to_string(scene.error());
    EXPECT_EQ(scene->image().text.text(), "// \u00e9 \U0001F600 \uFFFD  \nvoid mainImage(){}\n");
}

TEST_F(Json, each_missing_file_gives_one_warning) {
    const std::string wood = R"("ctype":"texture","id":6,"src":"/media/a/1f7dca9c22.jpg"})";
    const auto scene =
        load(project(image_with(R"({"channel":0,)" + wood + R"(,{"channel":1,)" + wood +
                                R"(,{"channel":2,"ctype":"musicstream","src":"https://a.example/b"},)"
                                R"({"channel":3,"ctype":"webcam","id":31})")));
    ASSERT_TRUE(scene) << to_string(scene.error());
    EXPECT_THAT(
        warnings_of(*scene),
        ElementsAre("x.json: warning: '/media/a/1f7dca9c22.jpg' (Wood) was not found: a generated picture of "
                    "1024x1024 replaces it (--media DIR names the folder with such files)",
                    "x.json: warning: 'https://a.example/b' was not found: ShaderToy's signal for silence "
                    "replaces it (--media DIR names the folder with such files)",
                    "x.json: warning: 'webcam' is a live input: a generated picture of 640x480 replaces it "
                    "without view --webcam"));
    EXPECT_EQ(scene->image().channels[2].input, ChannelInput(Music{}));
}

} // namespace tidemark::scene::json_test
