// Look-ups as SwiftShader filters them: the numbers that a driver makes of the rewritten text.
#include "media/picture_file.hpp"
#include "variation_test.hpp"

namespace tidemark::lab::swiftshader_lookups_gl_test {

using SwiftLookupTest = VariationTest;

/// A volume of bytes, between its texels and across its edges: the bits that Chromium 156 computed of it.
TEST_F(SwiftLookupTest, FiltersAreSwiftShaders) {
    std::string bytes("BIN\0\4\0\0\0\4\0\0\0\4\0\0\0\1\0\0\0", 20);
    for (int i = 0; i < 64; ++i)
        bytes += char(i * i * 37 % 251);
    put("volume.bin", bytes);
    const std::vector<std::string> expressions = {
        "textureLod(iChannel0, vec3(0.31, 0.47, 0.83), 0.0).x",
        "textureLod(iChannel0, vec3(1.93, -0.28, 3.02), 0.0).x",
        "textureLod(iChannel0, vec3(0.31, 0.47, 0.83), 0.7).x",
        "texture(iChannel0, vec3(p.x * 0.01, 0.47, 0.83)).x",
        "texture(iChannel0, vec3(p.x * 0.12, p.x * 0.47, 0.83)).x",
    };
    const auto bits = [&](int mode) {
        return varied_bits(like_swiftshader, mode, expressions, "#iChannel0 \"volume.bin\"\n");
    };
    EXPECT_EQ(bits(k_all_parts),
              (std::vector<uint32_t>{0x3EEC7CDD, 0x3EC20774, 0x3EEC7CDD, 0x3EF9ECD2, 0x3F1DA09A}));
    EXPECT_NE(bits(0), bits(k_all_parts)) << "this driver filters otherwise";
}

/// A nearest texel is found with 16 bits of the coordinate, in a smooth volume, too, where a linear filter
/// draws nearly the same. The bits are Chromium 156's.
TEST_F(SwiftLookupTest, NearestTexelsAreSwiftShaders) {
    std::string bytes("BIN\0\5\0\0\0\5\0\0\0\5\0\0\0\1\0\0\0", 20);
    for (int i = 0; i < 125; ++i)
        bytes += char(100 + i % 5 + 3 * (i / 5 % 5) + i / 25);
    put("smooth.bin", bytes);
    const std::vector<std::string> expressions = {
        "textureLod(iChannel0, vec3(0.2, 0.47, 0.83), 0.0).x",
        "textureLod(iChannel0, vec3(0.31, 0.6, 0.83), 0.0).x",
        "texture(iChannel0, vec3(p.x * 0.16, 0.47, 0.2)).x",
        "textureLod(iChannel0, vec3(-0.8, 0.47, 3.2), 0.0).x",
        "look_up(iChannel0, vec3(0.2, 0.47, 0.83))",
    };
    const auto bits = [&](std::string_view filter, int mode) {
        const std::string before = fmt::format("#iChannel0 \"smooth.bin\"\n#iChannel0::MinFilter \"{0}\"\n"
                                               "#iChannel0::MagFilter \"{0}\"\n"
                                               "float look_up(sampler3D s, vec3 p) {{\n"
                                               "return textureLod(s, p, 0.0).x; }}\n",
                                               filter);
        return varied_bits(like_swiftshader, mode, expressions, before);
    };
    const std::vector<uint32_t> nearest = {0x3EDCDCDE, 0x3EDEDEE0, 0x3ED6D6D8, 0x3ED6D6D8, 0x3EDCDCDE};
    const std::vector<uint32_t> linear = {0x3EDC42AB, 0x3EE147B0, 0x3ED7F18C, 0x3ED5EF8A, 0x3EDC42AB};
    EXPECT_EQ(bits("Nearest", k_all_parts), nearest);
    EXPECT_EQ(bits("Linear", k_all_parts), linear);
    filters_ = 1; // it does not depend on the driver's filter then
    EXPECT_EQ(bits("Linear", k_all_parts), nearest);
    filters_ = 1 << 16 | 2; // the nearest texel of iChannel1 only, which `look_up` does not read
    EXPECT_EQ(bits("Nearest", k_all_parts), linear);
    EXPECT_NE(bits("Nearest", 0)[0], 0x3EDCDCDEu) << "this driver finds texels with 16 bits, too";
}

/// Faces of 4x4 bytes: within a face, over an edge, in a corner, and where all three numbers are as large.
/// The bits are Chromium 156's.
TEST_F(SwiftLookupTest, CubesAreFilteredAsBySwiftShader) {
    image::Image upright({16, 12}, 3, image::SampleType::u8);
    for (int i = 0; i < 16 * 12 * 3; ++i) {
        const int channel = i % 3, x = i / 3 % 16, y = i / 48;
        upright.u8()[size_t(i)] = uint8_t((x * x * 37 + y * 91 * (x + 1) + channel * 53) % 251);
    }
    ASSERT_TRUE(image::write_picture(path_of("cross.png"), image::flipped(upright)));
    const std::vector<std::string> expressions = {"textureLod(iChannel0, vec3(1.0, 0.31, -0.47), 0.0).x",
                                                  "textureLod(iChannel0, vec3(-0.83, 0.31, 0.82), 0.0).y",
                                                  "textureLod(iChannel0, vec3(0.79, -0.83, 0.81), 0.0).z",
                                                  "textureLod(iChannel0, vec3(-1.0, 1.0, -1.0), 0.0).x",
                                                  "texture(iChannel0, vec3(0.2, 0.1, -0.9), 99.0).x"};
    const auto bits = [&](std::string_view filter, std::string_view mipmaps, int mode) {
        const std::string before =
            fmt::format("#iChannel0 \"cross.png\"\n#iChannel0::Type \"CubeMap\"\n#iChannel0::MinFilter "
                        "\"{0}{1}\"\n#iChannel0::MagFilter \"{0}\"\n",
                        filter, mipmaps);
        return varied_bits(like_swiftshader, mode, expressions, before);
    };
    const std::vector<uint32_t> linear = {0x3F1D0C77, 0x3F2B0141, 0x3F536CC8, 0x3F3BBBBC, 0x3E9A3050};
    EXPECT_EQ(bits("Linear", "MipMapLinear", k_all_parts), linear);
    EXPECT_NE(bits("Linear", "MipMapLinear", 0)[3], linear[3]) << "this driver takes the same face";
    EXPECT_EQ(bits("Nearest", "", k_all_parts),
              (std::vector<uint32_t>{0x3F2BABAC, 0x3F46C6C8, 0x3F55D5D7, 0x3EF4F4F6, 0x3E929293}));
}

/// A bias is at most 15. A coordinate that is the same in all pixels has level -31.75 and stays in level 0,
/// where llvmpipe takes the smallest mipmap. The bits are Chromium 156's.
TEST_F(SwiftLookupTest, ABiasIsLimitedAsInSwiftShader) {
    std::string bytes("BIN\0\4\0\0\0\4\0\0\0\4\0\0\0\1\0\0\0", 20);
    for (int i = 0; i < 64; ++i)
        bytes += char(i * i * 37 % 251);
    put("volume.bin", bytes);
    const std::string before = "#iChannel0 \"volume.bin\"\n#iChannel0::MinFilter \"LinearMipMapLinear\"\n";
    const std::vector<std::string> expressions = {
        "texture(iChannel0, vec3(0.31, 0.47, 0.83), 99.0).x",
        "texture(iChannel0, vec3(p.x * 0.12, p.x * 0.47, 0.83), -99.0).x",
        "texture(iChannel0, vec3(p.x * 1e-6, 0.47, 0.83), 19.0).x",
    };
    const auto bits = [&](int mode) { return varied_bits(like_swiftshader, mode, expressions, before); };
    EXPECT_EQ(bits(k_all_parts), (std::vector<uint32_t>{0x3EEC7CDD, 0x3F05EAA5, 0x3F010CA7}));
    EXPECT_NE(bits(0)[0], 0x3EEC7CDDu) << "this driver limits a bias, too";
}

/// `textureGrad` of a volume of blocks, whose mipmaps are exact, and of a cube. The bits are Chromium 156's.
TEST_F(SwiftLookupTest, GivenGradientsChooseSwiftShadersMipmap) {
    std::string bytes("BIN\0\4\0\0\0\4\0\0\0\4\0\0\0\1\0\0\0", 20);
    for (int i = 0; i < 64; ++i)
        bytes += char(24 * (i % 4 / 2 + 2 * (i / 4 % 4 / 2) + 5 * (i / 16 / 2)));
    put("blocks.bin", bytes);
    image::Image upright({16, 12}, 3, image::SampleType::u8);
    for (int i = 0; i < 16 * 12 * 3; ++i)
        upright.u8()[size_t(i)] = uint8_t(24 * (i / 3 % 16 / 2 + 2 * (i / 48 / 2) + 3 * (i % 3)) % 248);
    ASSERT_TRUE(image::write_picture(path_of("cross.png"), image::flipped(upright)));
    const std::string before = "#iChannel0 \"blocks.bin\"\n#iChannel0::MinFilter \"LinearMipMapLinear\"\n"
                               "#iChannel1 \"cross.png\"\n#iChannel1::Type \"CubeMap\"\n"
                               "#iChannel1::MinFilter \"LinearMipMapLinear\"\n"
                               "#define P vec3(0.31, 0.47, 0.83)\n";
    const std::vector<std::string> expressions = {
        "textureGrad(iChannel0, P, vec3(0.3, 0.1, 0.0), vec3(0.0, 0.2, 0.1)).x",
        "textureGrad(iChannel0, P, vec3(0.4, 0.1, 0.1), vec3(0.0, 0.7, 0.1)).x",
        "textureGrad(iChannel0, P, vec3(0.0), vec3(0.0)).x",
        "textureGrad(iChannel1, vec3(1.0, 0.31, -0.47), vec3(0.2, 0.1, 0.0), vec3(0.0, 0.4, 0.1)).x",
        "textureGrad(iChannel1, vec3(0.2, 0.1, -0.9), vec3(0.5, 0.1, 0.3), vec3(0.0, 0.4, 0.1)).y",
    };
    const auto bits = [&](int mode) { return varied_bits(like_swiftshader, mode, expressions, before); };
    EXPECT_EQ(bits(k_all_parts),
              (std::vector<uint32_t>{0x3F0676E7, 0x3EDDAA78, 0x3F0AC83A, 0x3F58D8DA, 0x3EAEDF55}));
    EXPECT_NE(bits(0)[0], 0x3F0676E7u) << "this driver filters otherwise";
}

/// Texels that are whole numbers are no bytes if they are above 1, or if the texture holds floats. Chromium
/// 156 and llvmpipe filter floats alike.
TEST_F(SwiftLookupTest, FloatsAreNotTakenForBytes) {
    std::string bytes("BIN\0\4\0\0\0\4\0\0\0\4\0\0\0\1\0\x0a\0", 20);
    for (int i = 0; i < 64; ++i)
        bytes.append(i % 4 == 0 ? "\0\0\x20\x43" : "\0\0\0\0", 4); // 160.0 and 0.0
    put("floats.bin", bytes);
    const std::string before =
        "#iChannel0 \"floats.bin\"\n#iChannel0::MinFilter \"Linear\"\n#iChannel0::MagFilter \"Linear\"\n";
    const std::vector<std::string> expressions = {
        "textureLod(iChannel0, vec3(0.125, 0.375, 0.375), 0.0).x",
        "textureLod(iChannel0, vec3(0.13, 0.375, 0.375), 0.0).x",
        "textureLod(iChannel0, vec3(0.31, 0.375, 0.377), 0.0).x",
    };
    const std::vector<float> known = {160.0f, 156.800003f, 41.5999985f};
    EXPECT_EQ(varied(like_swiftshader, k_all_parts, expressions, before), known);
    filters_ = 1 << 16 | 1 << 20;
    EXPECT_EQ(varied(like_swiftshader, k_all_parts, expressions, before), known);
}

} // namespace tidemark::lab::swiftshader_lookups_gl_test
