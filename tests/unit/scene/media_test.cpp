// ShaderToy's media: by every name they have had, in a folder, or replaced.
#include "scene/load_scene.hpp"
#include "scene/names.hpp"
#include "scene_support.hpp"

#include <gmock/gmock.h>

namespace tidemark::scene::media_test {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

TEST(Media, are_found_by_hash_old_name_and_id) {
    const Media* noise = find_media("/media/a/f735bee5b64ef98879dc.png");
    ASSERT_TRUE(noise);
    EXPECT_EQ(noise->title, "RGBA Noise Medium");
    EXPECT_EQ(find_media("/presets/tex16.png"), noise);
    EXPECT_EQ(find_media("tex16.png"), noise);
    EXPECT_EQ(find_media_by_id("30"), noise);
    EXPECT_EQ(find_media_by_id("Xsf3zn"), noise);
    EXPECT_EQ(find_media("/presets/cube00_0.jpg")->kind, MediaKind::cubemap);
    EXPECT_EQ(find_media("/media/a/585f9546_3.jpg")->title, "Uffizi Gallery");
    EXPECT_EQ(find_media(""), nullptr);
    EXPECT_EQ(find_media("tex160.png"), nullptr);
    EXPECT_EQ(find_media_by_id(""), nullptr);
}

TEST(Media, stand_ins_have_kind_and_size_of_the_missing_file) {
    const auto stand_in = [](MediaKind kind, const Media* media) {
        return substitute_for(kind, media).input;
    };
    EXPECT_EQ(stand_in(MediaKind::picture, find_media("tex14.png")),
              ChannelInput(StandIn{StandIn::Kind::picture, 256, 32, 4}));
    EXPECT_EQ(stand_in(MediaKind::picture, find_media("tex15.png")), ChannelInput(Noise{NoiseKind::bayer_8}));
    EXPECT_EQ(stand_in(MediaKind::volume, nullptr), ChannelInput(StandIn{StandIn::Kind::volume, 32, 32, 4}));
    EXPECT_EQ(stand_in(MediaKind::video, find_media("vid03.webm")),
              ChannelInput(StandIn{StandIn::Kind::picture, 352, 288, 4}));
    EXPECT_EQ(stand_in(MediaKind::music, nullptr), ChannelInput(Music{}));
    // Tables of other projects call everything a texture.
    EXPECT_EQ(stand_in(MediaKind::picture, find_media("cube00_0.jpg")),
              ChannelInput(StandIn{StandIn::Kind::picture, 512, 512, 4}));
}

TEST(Media, equivalent_substitutes_give_no_warning) {
    EXPECT_EQ(substitute_for(MediaKind::picture, find_media("tex15.png")).name, "");
    EXPECT_EQ(substitute_for(MediaKind::volume, nullptr).name, "a generated volume of 32x32");
    EXPECT_EQ(substitute_for(MediaKind::music, nullptr).name, "ShaderToy's signal for silence");
}

using MediaFiles = SceneFolder;

TEST_F(MediaFiles, are_found_by_path_name_and_alternative_name) {
    save("m/media/a/10eb4fe0aa.jpg", "");
    save("m/tex05.jpg", "");
    const MediaFolder media(path() / "m");
    EXPECT_EQ(media.find("/media/a/10eb4fe0aa.jpg"), path() / "m/media/a/10eb4fe0aa.jpg");
    EXPECT_EQ(media.find("https://www.shadertoy.com/media/a/10eb4fe0aa.jpg"),
              path() / "m/media/a/10eb4fe0aa.jpg");
    EXPECT_EQ(media.find("/presets/tex00.jpg"), path() / "m/media/a/10eb4fe0aa.jpg");
    EXPECT_EQ(media.find("/media/a/1f7dca9c22f3.jpg"), path() / "m/tex05.jpg");
    EXPECT_EQ(media.find("/media/a/../../../m/tex05.jpg"), path() / "m/tex05.jpg") << "its name, not its way";
    EXPECT_EQ(media.find("/media/a/unknown.jpg"), "");
    EXPECT_EQ(media.find(""), "");
    EXPECT_EQ(media.find(std::string(100'000, 'x')), "");
    EXPECT_EQ(MediaFolder("").find("tex05.jpg"), "");
}

TEST_F(MediaFiles, cubemaps_have_six_faces_or_one_file) {
    for (const char* name :
         {"585f9546.jpg", "585f9546_1.jpg", "585f9546_2.jpg", "585f9546_3.jpg", "585f9546_4.jpg"})
        save(std::string("m/") + name, "");
    EXPECT_THAT(MediaFolder(path() / "m").find_cubemap("/media/a/585f9546.jpg"), IsEmpty());
    save("m/585f9546_5.jpg", "");
    const auto faces = MediaFolder(path() / "m").find_cubemap("/presets/cube00_0.jpg");
    ASSERT_THAT(faces, SizeIs(6));
    EXPECT_EQ(faces.front(), path() / "m/585f9546.jpg");
    EXPECT_EQ(faces.back(), path() / "m/585f9546_5.jpg");
    save("n/panorama.hdr", "");
    EXPECT_THAT(MediaFolder(path() / "n").find_cubemap("panorama.hdr"),
                ElementsAre(path() / "n/panorama.hdr"));
    for (int face = 0; face < 6; ++face)
        save("o/cube02_" + std::to_string(face) + ".jpg", "");
    EXPECT_THAT(MediaFolder(path() / "o").find_cubemap("/media/a/488bd403aa.jpg"), SizeIs(6));
}

TEST_F(MediaFiles, replace_generated_media) {
    save("m/f735bee5.png", "");
    save("m/a6a1cf7a.mp3", "");
    save("m/27012b4e.bin", "");
    save("m/35c87bcb.webm", "");
    save("x.json", R"([{"type":"image","code":"mainImage","inputs":[
        {"channel":0,"ctype":"texture","id":30,"src":"/media/a/f735bee5.png"},
        {"channel":1,"ctype":"music","src":"/media/a/a6a1cf7a.mp3"},
        {"channel":2,"ctype":"volume","src":"/media/a/27012b4e.bin"},
        {"channel":3,"ctype":"video","src":"/media/a/35c87bcb.webm"}]}])");
    LoadOptions options;
    options.media = path() / "m";
    const Scene scene = load("x.json", options);
    EXPECT_EQ(input(scene, 0, 0), ChannelInput(Picture{path() / "m/f735bee5.png"}));
    EXPECT_EQ(input(scene, 0, 1), ChannelInput(Music{path() / "m/a6a1cf7a.mp3"}));
    EXPECT_EQ(input(scene, 0, 2), ChannelInput(Volume{path() / "m/27012b4e.bin"}));
    EXPECT_EQ(input(scene, 0, 3), ChannelInput(Video{path() / "m/35c87bcb.webm"}));
    EXPECT_THAT(scene.files, SizeIs(5));
    EXPECT_THAT(scene.warnings, IsEmpty());
    EXPECT_EQ(input(load("x.json"), 0, 0), ChannelInput(Noise{NoiseKind::rgba_256}));
}

TEST_F(MediaFiles, have_shadertoys_channels) {
    save("m/ad56fba9.jpg", "");
    save("x.json", R"([{"type":"image","code":"mainImage","inputs":[
        {"channel":0,"ctype":"texture","src":"/media/a/ad56fba9.jpg"}]}])");
    LoadOptions options;
    options.media = path() / "m";
    EXPECT_EQ(input(load("x.json", options), 0, 0), ChannelInput(Picture{path() / "m/ad56fba9.jpg", true}));
}

} // namespace tidemark::scene::media_test
