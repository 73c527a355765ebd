// #iChannelN: what a channel reads and how it is sampled.
#include "directives_support.hpp"
#include "support/naming.hpp"

#include <gtest/gtest.h>

namespace tidemark::scene::channel_directives_test {

constexpr Sampling k_extension{Filter::linear, Filter::linear, Mipmaps::none, Wrap::repeat, true};

Channel channel_0(std::string_view text) {
    const auto directives = read(text);
    EXPECT_TRUE(directives) << to_string(directives.error());
    return directives ? directives->channels[0] : Channel{};
}

TEST(ChannelDirectives, an_undeclared_channel_reads_noise_with_shadertoys_sampling) {
    const auto directives = read("void mainImage() {}");
    ASSERT_TRUE(directives);
    for (const Channel& channel : directives->channels) {
        EXPECT_EQ(channel.input, ChannelInput(Noise{}));
        EXPECT_EQ(channel.sampling, k_texture_sampling);
        EXPECT_EQ(channel.where, SourceLocation{});
    }
    EXPECT_TRUE(directives->knobs.empty());
}

TEST(ChannelDirectives, each_number_is_a_separate_channel) {
    const auto directives =
        read("#iChannel0 \"0.png\"\n#iChannel1 '1.png'\n#iChannel2 \"2.png\"\n#iChannel3 \"3.png\"");
    ASSERT_TRUE(directives);
    for (size_t i = 0; i < 4; ++i) {
        const std::string name = std::to_string(i) + ".png";
        EXPECT_EQ(directives->channels[i].input, ChannelInput(Picture{"dir/" + name}));
        EXPECT_EQ(directives->channels[i].where, (SourceLocation{"dir/a.glsl", int(i) + 1, 0}));
    }
}

TEST(ChannelDirectives, a_picture_has_the_sampling_of_the_extension) {
    EXPECT_EQ(channel_0("#iChannel0 \"a.png\"").sampling, k_extension);
}

TEST(ChannelDirectives, noise_by_name) {
    const Channel channel = channel_0("\n#iChannel0 \"noise\"");
    EXPECT_EQ(channel.input, ChannelInput(Noise{}));
    EXPECT_EQ(channel.sampling, k_texture_sampling);
    EXPECT_EQ(channel.where, (SourceLocation{"dir/a.glsl", 2, 0}));
}

TEST(ChannelDirectives, names_are_relative_to_the_file_of_the_directive) {
    const auto input = [](std::string_view text) { return std::get<Picture>(channel_0(text).input).file; };
    EXPECT_EQ(input("#iChannel0 \"../textures/a.png\""), "textures/a.png");
    EXPECT_EQ(input("#iChannel0 \"/abs/a.png\""), "/abs/a.png");
    EXPECT_EQ(input("#iChannel0 \"file://a.png\""), "dir/a.png");
    EXPECT_EQ(input("#iChannel0 \"file:///abs/a.png\""), "/abs/a.png");
    EXPECT_EQ(input(R"(#iChannel0 "a \"b\" \\c.png")"), "dir/a \"b\" \\c.png");
    EXPECT_EQ(input(R"(#iChannel0 "sub\c.png")"), "dir/sub\\c.png")
        << "the file is looked for, and the hint names sub/c.png";
}

TEST(ChannelDirectives, urls_are_refused) {
    EXPECT_THAT(refusal("\n#iChannel0 \"https://x.org/a.png\""),
                naming("dir/a.glsl:2: error:", "'https://x.org/a.png'"));
}

TEST(ChannelDirectives, every_minification_filter) {
    struct Case {
        const char* name;
        Filter filter;
        Mipmaps mipmaps;
    };
    for (const Case& wanted : {Case{"Nearest", Filter::nearest, Mipmaps::none},
                               Case{"NearestMipMapNearest", Filter::nearest, Mipmaps::nearest},
                               Case{"NearestMipMapLinear", Filter::nearest, Mipmaps::linear},
                               Case{"Linear", Filter::linear, Mipmaps::none},
                               Case{"LinearMipMapNearest", Filter::linear, Mipmaps::nearest},
                               Case{"LinearMipMapLinear", Filter::linear, Mipmaps::linear}}) {
        Sampling expected = k_extension;
        expected.minify = wanted.filter;
        expected.mipmaps = wanted.mipmaps;
        const std::string parameter = std::string("#iChannel0::MinFilter \"") + wanted.name + "\"";
        EXPECT_EQ(channel_0("#iChannel0 \"a.png\"\n" + parameter).sampling, expected) << wanted.name;
        EXPECT_EQ(channel_0(parameter + "\n#iChannel0 \"a.png\"").sampling, expected) << wanted.name;
    }
}

TEST(ChannelDirectives, every_magnification_filter_and_wrap_mode) {
    Sampling expected = k_extension;
    for (const auto& [name, filter] : {std::pair("Nearest", Filter::nearest), {"Linear", Filter::linear}}) {
        expected.magnify = filter;
        EXPECT_EQ(channel_0(std::string("#iChannel0 \"a\" #iChannel0::MagFilter \"") + name + "\"").sampling,
                  expected);
    }
    expected = k_extension;
    for (const auto& [name, wrap] :
         {std::pair("Repeat", Wrap::repeat), {"Clamp", Wrap::clamp}, {"Mirror", Wrap::mirror}}) {
        expected.wrap = wrap;
        EXPECT_EQ(channel_0(std::string("#iChannel0 \"a\" #iChannel0::WrapMode \"") + name + "\"").sampling,
                  expected);
    }
}

TEST(ChannelDirectives, parameters_of_noise_change_only_their_own_setting) {
    Sampling expected = k_texture_sampling;
    expected.wrap = Wrap::clamp;
    EXPECT_EQ(channel_0("#iChannel0 \"noise\"\n#iChannel0::WrapMode \"Clamp\"").sampling, expected);
    EXPECT_EQ(channel_0("#iChannel0::WrapMode \"Clamp\"\n#iChannel0 \"noise\"").sampling, expected);
    EXPECT_EQ(channel_0("#iChannel0::WrapMode \"Clamp\"").sampling, expected);
}

TEST(ChannelDirectives, the_type_is_a_plain_texture_or_a_cubemap) {
    EXPECT_EQ(channel_0("#iChannel0 \"a.png\"\n#iChannel0::Type \"Texture2D\"").sampling, k_extension);
    const std::string type = "#iChannel0::Type \"CubeMap\"\n";
    for (const std::string& text : {type + "#iChannel0 \"a_*.png\"", "#iChannel0 \"a_*.png\"\n" + type})
        EXPECT_EQ(channel_0(text).input, ChannelInput(Cubemap{{"dir/a_*.png"}}));
    EXPECT_EQ(refusal("#iChannel0::Type \"Cubemap\""),
              "dir/a.glsl:1:13: error: Type \"Cubemap\": give Texture2D or CubeMap");
}

TEST(ChannelDirectives, the_extension_selects_the_kind_of_input) {
    const auto input = [](const std::string& name) { return channel_0("#iChannel0 \"" + name + "\"").input; };
    for (const char* name : {"a.mp3", "a.ogg", "a.WAV", "a.flac"})
        EXPECT_EQ(input(name), ChannelInput(Music{std::string("dir/") + name}));
    for (const char* name : {"a.mp4", "a.webm", "a.ogv", "a.gif"})
        EXPECT_EQ(input(name), ChannelInput(Video{std::string("dir/") + name}));
    EXPECT_EQ(input("a.bin"), ChannelInput(Volume{"dir/a.bin"}));
    EXPECT_EQ(input("a"), ChannelInput(Picture{"dir/a"}));
    EXPECT_EQ(input("keyboard"), ChannelInput(Keyboard{}));
    EXPECT_EQ(channel_0("#iChannel0 \"keyboard\"").sampling, k_keyboard_sampling);
}

TEST(ChannelDirectives, names_of_passes_stay_unbound) {
    for (const std::string name : {"self", "buffer_a", "Buffer A", "blur.glsl", "../b.frag"}) {
        const auto directives = read("#iChannel2 \"file://" + name + "\"");
        ASSERT_TRUE(directives);
        EXPECT_EQ(directives->channels[2].input, ChannelInput(Unbound{}));
        EXPECT_EQ(directives->sources[2], name);
    }
}

TEST(ChannelDirectives, may_run_over_lines_and_around_comments) {
    const Channel channel = channel_0("#iChannel0 // why\n  ::\n MinFilter /* how */ \\\n \"Nearest\"");
    EXPECT_EQ(channel.sampling.minify, Filter::nearest);
}

TEST(ChannelDirectives, invalid_values) {
    EXPECT_THAT(refusal("#iChannel0::MinFilter \"nearest\""),
                naming("dir/a.glsl:1:13: error: MinFilter \"nearest\":", "MipMapNearest"));
    EXPECT_EQ(refusal("#iChannel0::MagFilter \"NearestMipMapLinear\""),
              "dir/a.glsl:1:13: error: MagFilter \"NearestMipMapLinear\": give Nearest or Linear");
    EXPECT_EQ(refusal("#iChannel0::WrapMode \"Border\""),
              "dir/a.glsl:1:13: error: WrapMode \"Border\": give Repeat, Clamp or Mirror");
    EXPECT_THAT(refusal("\n#iChannel0::Filter \"Linear\""),
                naming("dir/a.glsl:2:13: error:", "'Filter'", "MinFilter"));
}

TEST(ChannelDirectives, invalid_channel_numbers) {
    for (const std::string name : {"iChannel10", "iChannel", "iChannel00", "iChannelA"})
        EXPECT_EQ(refusal("#" + name + " \"a.png\""),
                  "dir/a.glsl:1: error: #" + name + ": the channels are iChannel0 to iChannel9");
}

TEST(ChannelDirectives, missing_parts_are_reported) {
    EXPECT_THAT(refusal("#iChannel0 noise\n"),
                naming("dir/a.glsl:1:12: error:", "needs quotes", "\"noise\""));
    EXPECT_THAT(refusal("#iChannel0"),
                naming("dir/a.glsl:1:11: error:", "name in quotes", "the end of the file"));
    EXPECT_THAT(refusal("#iChannel0 \"a.png\nfloat x;"),
                naming("dir/a.glsl:1:12: error:", "name in quotes", "'\"'"));
    EXPECT_EQ(refusal("#iChannel0:WrapMode \"Clamp\""),
              "dir/a.glsl:1:12: error: expected ':' but found 'WrapMode'");
    EXPECT_THAT(refusal("#iChannel0::WrapMode Clamp"),
                naming("dir/a.glsl:1:22: error:", "name in quotes", "'Clamp'"));
    EXPECT_THAT(refusal("#iChannel0::"),
                naming("dir/a.glsl:1:13: error:", "MinFilter", "the end of the file"));
    EXPECT_THAT(refusal("#iChannel0 \"\""), naming("dir/a.glsl:1: error:", "is empty"));
}

TEST(ChannelDirectives, vflip_sets_the_flag) {
    EXPECT_TRUE(channel_0("#iChannel0 \"a.png\"").sampling.vflip);
    EXPECT_FALSE(channel_0("#iChannel0 \"a.png\"\n#iChannel0::VFlip \"false\"").sampling.vflip);
    EXPECT_NE(refusal("#iChannel0::VFlip \"no\"").find("give true or false"), std::string::npos);
}

TEST(ChannelDirectives, a_name_without_quotes_is_suggested_with_quotes) {
    EXPECT_EQ(refusal("\n#iChannel2 file://a/b.png // x"),
              "dir/a.glsl:2:12: error: the name needs quotes: #iChannel2 \"file://a/b.png\"");
}

} // namespace tidemark::scene::channel_directives_test
