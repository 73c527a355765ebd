// Projects taken apart into files and put together again; scenes that never were projects made into one.
#include "base/file.hpp"
#include "scene/project_exchange.hpp"
#include "scene_support.hpp"
#include "support/naming.hpp"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace tidemark::scene::export_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Json = nlohmann::ordered_json;

class Export : public SceneFolder {
protected:
    /// Takes the text apart into the folder `name` and puts it together again.
    std::string there_and_back(const std::string& text, const std::string& name) const {
        const auto files = split_project(text, "x.json");
        EXPECT_TRUE(files) << to_string(files.error());
        if (!files)
            return {};
        for (const ProjectFile& file : *files)
            save(name + "/" + file.name, file.bytes);
        const auto joined = join_project(path() / name, Bounds(path() / name, false));
        EXPECT_TRUE(joined) << to_string(joined.error());
        return joined.value_or("");
    }

    Json made_of(const std::string& scene) {
        warnings_.clear();
        const auto made = make_project(load(scene), warnings_);
        EXPECT_TRUE(made) << to_string(made.error());
        return made ? Json::parse(*made) : Json();
    }

    std::vector<Diagnostic> warnings_;
};

std::string case_file(const std::string& name) {
    return read_file(std::string(TIDEMARK_SOURCE_DIR) + "/tests/cases/projects/" + name).value_or("");
}

std::vector<std::string> names_of(const std::vector<ProjectFile>& files) {
    std::vector<std::string> names;
    for (const ProjectFile& file : files)
        names.push_back(file.name);
    return names;
}

TEST_F(Export, every_field_in_its_place_and_every_byte_of_code) {
    for (const char* name : {"api.json", "site.json", "2014.json", "odd.json"}) {
        const std::string text = case_file(name);
        ASSERT_FALSE(text.empty()) << name;
        EXPECT_EQ(Json::parse(there_and_back(text, name)).dump(), Json::parse(text).dump()) << name;
    }
}

TEST_F(Export, a_folder_draws_what_its_project_draws) {
    for (const char* name : {"api.json", "site.json", "2014.json", "odd.json"}) {
        save(name, case_file(name));
        there_and_back(case_file(name), std::string(name) + ".d");
        const Scene file = load(name);
        const Scene folder = load(std::string(name) + ".d");
        EXPECT_EQ(scene::names_of(folder), scene::names_of(file));
        EXPECT_EQ(folder.common.text(), file.common.text());
        for (size_t i = 0; i < file.passes.size(); ++i) {
            EXPECT_EQ(folder.passes[i].text.text(), file.passes[i].text.text());
            for (size_t channel = 0; channel < k_channel_count; ++channel) {
                EXPECT_EQ(input(folder, i, channel), input(file, i, channel)) << name << i << channel;
                EXPECT_EQ(folder.passes[i].channels[channel].sampling,
                          file.passes[i].channels[channel].sampling);
            }
        }
    }
}

TEST_F(Export, files_have_the_names_of_the_passes) {
    EXPECT_THAT(names_of(*split_project(case_file("api.json"), "x.json")),
                ElementsAre("image.glsl", "buffer_a.glsl", "common.glsl", "scene.json"));
    EXPECT_THAT(names_of(*split_project(case_file("odd.json"), "x.json")),
                ElementsAre("common.glsl", "buffer_b.glsl", "common_2.glsl", "image.glsl", "scene.json"));
    EXPECT_EQ(split_project(case_file("odd.json"), "x.json")->at(2).bytes, "#define B 0.5\r");
}

TEST_F(Export, a_list_of_passes_survives) {
    const std::string text = R"([{"type":"image","code":"a"},{"code":"b","type":"common"}])";
    EXPECT_EQ(Json::parse(there_and_back(text, "d")).dump(), Json::parse(text).dump());
}

TEST_F(Export, invalid_projects_are_not_split) {
    const auto refused = [](const std::string& text) {
        return to_string(split_project(text, "x.json").error());
    };
    EXPECT_THAT(refused("{}"), naming("x.json: error:", "no list named renderpass"));
    EXPECT_THAT(refused(R"([{"type":"image","code":{"file":"image.glsl"}}])"),
                naming("x.json: error:", "pass 1", "'image.glsl'", "scene.json"));
}

TEST_F(Export, invalid_folders_are_not_joined) {
    const auto refused = [&] {
        return plain(to_string(join_project(path(), Bounds(path(), false)).error()));
    };
    EXPECT_EQ(refused(), "tidemark: error: cannot read 'scene.json': no such file");
    save("scene.json", R"([{"type":"image","code":{"file":"image.glsl"}}])");
    EXPECT_EQ(refused(), "tidemark: error: cannot read 'image.glsl': no such file");
    save("image.glsl", "// caf\xE9\n");
    EXPECT_THAT(refused(), naming("'image.glsl'"));
    save("scene.json", R"([{"type":"image","code":{"file":"../image.glsl"}}])");
    EXPECT_THAT(refused(), HasSubstr("lies outside the scene's folder"));
}

TEST_F(Export, the_text_of_common_keeps_its_end) {
    for (const std::string code : {"int c;", "int c;\n", "int c;\n\n"}) {
        save("x.json",
             Json::array({{{"type", "image"}, {"code", k_main_image}}, {{"type", "common"}, {"code", code}}})
                 .dump());
        EXPECT_EQ(made_of("x.json")["Shader"]["renderpass"][1]["code"], code);
    }
}

TEST_F(Export, a_file_becomes_a_project) {
    save("lib.glsl", "float one() { return 1.0; }\n");
    save("a.glsl",
         "#include \"lib.glsl\"\n#iUniform float speed = 2.0\n#iUniform color3 tint = color3(1.0, 0.5, 0.0)\n"
         "#iChannel0 \"noise\"\n#iChannel1 \"own.png\"\n#iChannel1::WrapMode \"Clamp\"\n" +
             k_main_image + "// iChannel0 iChannel1\n");
    const Json project = made_of("a.glsl");
    const Json& passes = project["Shader"]["renderpass"];
    ASSERT_EQ(passes.size(), 2u);
    EXPECT_EQ(passes[1]["code"], "const float speed = 2.0;\nconst vec3 tint = vec3(1, 0.5, 0);");
    EXPECT_EQ(passes[1]["type"], "common");
    EXPECT_THAT(passes[0]["code"].get<std::string>(), testing::StartsWith("float one() { return 1.0; }\n"));
    ASSERT_EQ(passes[0]["inputs"].size(), 2u);
    EXPECT_EQ(passes[0]["inputs"][0]["id"], 30);
    EXPECT_EQ(passes[0]["inputs"][0]["sampler"]["filter"], "mipmap");
    EXPECT_EQ(passes[0]["inputs"][1]["src"], "own.png");
    EXPECT_EQ(passes[0]["inputs"][1]["sampler"]["wrap"], "clamp");
    ASSERT_EQ(warnings_.size(), 1u);
    EXPECT_EQ(plain(to_string(warnings_[0])),
              "a.glsl:5: warning: ShaderToy has no 'own.png': choose another input there");
}

TEST_F(Export, a_project_that_we_made_is_the_same_scene) {
    save("s/image.glsl",
         "#iChannel0 \"buffer_b\"\n#iChannel2 \"keyboard\"\n" + k_main_image + "// iChannel0 iChannel2\n");
    save("s/buffer_b.glsl", "#iChannel3 \"self\"\n#iChannel3::MinFilter \"LinearMipMapLinear\"\n" +
                                k_main_image + "// iChannel3\n");
    const Json project = made_of("s");
    EXPECT_THAT(warnings_, IsEmpty());
    save("x.json", project.dump());
    const Scene again = load("x.json");
    EXPECT_THAT(scene::names_of(again), ElementsAre("Buffer B", "Image"));
    EXPECT_EQ(input(again, 0, 3), ChannelInput(PassOutput{0}));
    EXPECT_EQ(again.passes[0].channels[3].sampling.mipmaps, Mipmaps::linear);
    EXPECT_EQ(input(again, 1, 0), ChannelInput(PassOutput{0}));
    EXPECT_EQ(input(again, 1, 2), ChannelInput(Keyboard{}));
}

TEST_F(Export, live_inputs_stay_live) {
    save("a.glsl",
         "#iChannel0 \"microphone\"\n#iChannel1 \"webcam\"\n" + k_main_image + "// iChannel0 iChannel1\n");
    const Json project = made_of("a.glsl");
    EXPECT_THAT(warnings_, IsEmpty());
    EXPECT_EQ(project["Shader"]["renderpass"][0]["inputs"][0]["ctype"], "mic");
    EXPECT_EQ(project["Shader"]["renderpass"][0]["inputs"][1]["ctype"], "webcam");
    save("x.json", project.dump());
    const Scene again = load("x.json");
    EXPECT_EQ(input(again, 0, 0), ChannelInput(Music{}));
    EXPECT_EQ(input(again, 0, 1), ChannelInput(Video{}));
}

TEST_F(Export, too_many_buffers_are_refused) {
    std::string image = k_main_image;
    for (int i = 0; i < 4; ++i)
        save(std::to_string(i) + ".glsl",
             "#iChannel0 \"" + std::to_string(i + 1) + ".glsl\"\n" + k_main_image);
    save("4.glsl", "#iChannel0 \"self\"\n" + k_main_image);
    EXPECT_EQ(made_of("0.glsl")["Shader"]["renderpass"].size(), 5u);
    save("4.glsl", "#iChannel0 \"5.glsl\"\n" + k_main_image);
    save("5.glsl", k_main_image);
    const auto refused = make_project(load("0.glsl"), warnings_);
    ASSERT_FALSE(refused);
    EXPECT_THAT(plain(to_string(refused.error())), naming("'0.glsl'"));
}

TEST_F(Export, knobs_become_constants_of_their_types) {
    save("a.glsl", "#iUniform float a = 2\n#iUniform int n = 3\n#iUniform color3 c = color3(1, 0.5, 0)\n"
                   "uniform bool plain;\nvoid mainImage(out vec4 o, in vec2 p) { o = vec4(c * a, n); }\n");
    EXPECT_EQ(knobs_as_constants(load("a.glsl")),
              "const float a = 2.0;\nconst int n = 3;\nconst vec3 c = vec3(1, 0.5, 0);\n");
}

} // namespace tidemark::scene::export_test
