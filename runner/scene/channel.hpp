// Channels of a pass: sampling parameters, kinds of input, and the channel itself.
//
// Sampling parameters of textures, and the defaults of ShaderToy's editor for each kind of input.
#pragma once

#include "base/error.hpp"

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace tidemark::scene {

enum class Filter { nearest, linear };
enum class Mipmaps { none, nearest, linear };
enum class Wrap { repeat, clamp, mirror };

struct Sampling {
    Filter magnify = Filter::linear;
    Filter minify = Filter::linear;
    Mipmaps mipmaps = Mipmaps::none;
    Wrap wrap = Wrap::repeat;
    bool vflip = true; ///< t = 0 is the bottom row of the picture; false: its top row

    bool operator==(const Sampling&) const = default;
};

/// ShaderToy's default for a texture: mipmaps, repeat, flipped.
inline constexpr Sampling k_texture_sampling{Filter::linear, Filter::linear, Mipmaps::linear, Wrap::repeat,
                                             true};

/// ShaderToy's default for a buffer.
inline constexpr Sampling k_buffer_sampling{Filter::linear, Filter::linear, Mipmaps::none, Wrap::clamp, true};
/// ShaderToy's default for a cubemap.
inline constexpr Sampling k_cubemap_sampling{Filter::linear, Filter::linear, Mipmaps::none, Wrap::clamp,
                                             false};

/// ShaderToy's default for a volume.
inline constexpr Sampling k_volume_sampling{Filter::linear, Filter::linear, Mipmaps::linear, Wrap::repeat,
                                            false};
/// The VS Code extension's default for data with its first row on top.
inline constexpr Sampling k_unflipped{Filter::linear, Filter::linear, Mipmaps::none, Wrap::repeat, false};
/// Keys are bits, so they are not interpolated.
inline constexpr Sampling k_keyboard_sampling{Filter::nearest, Filter::nearest, Mipmaps::none, Wrap::clamp,
                                              true};

// The inputs of `iChannelN`: one type per kind, and one table of a kind's properties. To add a kind, add a
// type, its place in ChannelInput and its row. Values only; nothing is loaded here.

/// The kind of GLSL sampler that an input needs.
enum class TextureKind { flat, cube, volume };

/// No input: reads give black. Keeps the kind of sampler: reading a cubemap pass that the project lacks is
/// still a read of a cube.
struct Unbound {
    TextureKind kind = TextureKind::flat;
    TextureKind texture() const { return kind; }
    bool operator==(const Unbound&) const = default;
};

/// Noise textures that the program generates (media/generated_textures.hpp) in place of ShaderToy's, with the
/// same size, number of channels and structure.
enum class NoiseKind {
    rgba_256,
    rgba_64,
    grey_256,
    grey_64,
    blue_1024,
    bayer_8,
    grey_volume_32,
    rgba_volume_32
};
struct Noise {
    NoiseKind kind = NoiseKind::rgba_256;
    TextureKind texture() const {
        return kind >= NoiseKind::grey_volume_32 ? TextureKind::volume : TextureKind::flat;
    }
    bool operator==(const Noise&) const = default;
};

/// A picture file.
struct Picture {
    std::filesystem::path file;
    bool one_channel = false; ///< one of ShaderToy's media that has only red there, whatever the file holds
    bool operator==(const Picture&) const = default;
};

/// The output of a pass of the scene: a buffer, or the cube of a cubemap pass. Whether it is this frame's or
/// the last one's depends on the order of the passes (render/frame_plan.hpp).
struct PassOutput {
    size_t pass = 0; ///< index into Scene::passes
    bool operator==(const PassOutput&) const = default;
};

/// Six square faces (+x -x +y -y +z -z), or one file: a cross or an equirectangular panorama.
struct Cubemap {
    std::vector<std::filesystem::path> files;
    bool operator==(const Cubemap&) const = default;
};

/// A volume in ShaderToy's `.bin` format.
struct Volume {
    std::filesystem::path file;
    bool operator==(const Volume&) const = default;
};

/// 256 columns, one per JavaScript key code; rows: down, pressed in this frame, toggled. The texture of
/// `#iKeyboard` has a fourth row: released in this frame.
struct Keyboard {
    int rows = 3;
    bool operator==(const Keyboard&) const = default;
};

/// Spectrum and wave of a sound file, 512 x 2 texels; without a file, ShaderToy's signal for a silent input.
struct Music {
    std::filesystem::path file;
    bool operator==(const Music&) const = default;
};

/// Frames of a video file.
struct Video {
    std::filesystem::path file;
    bool operator==(const Video&) const = default;
};

/// A generated picture, cube or volume of the same kind and size, in place of a file that is missing.
struct StandIn {
    enum class Kind { picture, cubemap, volume };
    Kind kind = Kind::picture;
    int width = 512;
    int height = 512;
    int channels = 4;
    TextureKind texture() const {
        return kind == Kind::cubemap  ? TextureKind::cube
               : kind == Kind::volume ? TextureKind::volume
                                      : TextureKind::flat;
    }
    bool operator==(const StandIn&) const = default;
};

/// A picture of one value, as a test input.
struct Constant {
    enum class Kind { black, white, nan, texel }; ///< texel: one grey texel
    Kind kind = Kind::black;
    bool operator==(const Constant&) const = default;
};

using ChannelInput = std::variant<Unbound, Noise, Picture, PassOutput, Cubemap, Volume, Keyboard, Music,
                                  Video, StandIn, Constant>;

/// The source of an input, and the member of its type that names it.
enum class ReadsFrom {
    nothing,
    file,  ///< `file`; it may be empty
    files, ///< `files`
    pass,  ///< `pass`
};

/// The reason for which an input can change from frame to frame.
enum class Changes { never, with_clock, with_keys, with_passes };

struct InputTraits {
    size_t kind;                ///< k_kind of the type
    std::string_view name;      ///< `inspect`'s name for an input without a file
    bool by_name;               ///< directives and `--channel` accept this name
    std::string_view site_type; ///< `ctype` in ShaderToy's JSON; empty: not exported
    ReadsFrom from;
    Changes changes;
    bool loaded;                        ///< iChN.loaded: there is data to read
    bool default_input;                 ///< may be at a channel for which no input was named
    std::optional<TextureKind> texture; ///< nullopt: depends on the input, `texture()`
    Sampling sampling;                  ///< for an input that a directive or `--channel` names
};

template <class Kind, class... Kinds>
consteval size_t place_of(std::type_identity<std::variant<Kinds...>>) {
    size_t place = 0;
    (void)((std::is_same_v<Kind, Kinds> || (++place, false)) || ...);
    return place;
}
/// The index of a kind in ChannelInput.
template <class Kind>
inline constexpr size_t k_kind = place_of<Kind>(std::type_identity<ChannelInput>());

// clang-format off
inline constexpr auto k_input_traits = [] {
    using enum ReadsFrom;
    using enum Changes;
    using enum TextureKind;
    constexpr std::nullopt_t each = std::nullopt; // depends on the input: texture()
    return std::to_array<InputTraits>({
        // kind             name             by_name  site_type   from     changes      loaded  default  texture  sampling
        {k_kind<Unbound>,    "none",          false,   "",         nothing, never,       false,  true,    each,    {}},
        {k_kind<Noise>,      "noise",         true,    "texture",  nothing, never,       true,   true,    each,    k_texture_sampling},
        {k_kind<Picture>,    "picture",       false,   "texture",  file,    never,       true,   false,   flat,    {}},
        {k_kind<PassOutput>, "pass",          false,   "buffer",   pass,    with_passes, true,   false,   each,    {}},
        {k_kind<Cubemap>,    "cubemap",       false,   "cubemap",  files,   never,       true,   false,   cube,    k_unflipped},
        {k_kind<Volume>,     "volume",        false,   "volume",   file,    never,       true,   false,   volume,  k_unflipped},
        {k_kind<Keyboard>,   "keyboard",      true,    "keyboard", nothing, with_keys,   true,   false,   flat,    k_keyboard_sampling},
        {k_kind<Music>,      "silent signal", false,   "music",    file,    with_clock,  true,   false,   flat,    {}},
        {k_kind<Video>,      "video",         false,   "video",    file,    with_clock,  true,   false,   flat,    {}},
        {k_kind<StandIn>,    "stand-in",      false,   "texture",  nothing, never,       true,   false,   each,    {}},
        {k_kind<Constant>,   "one value",     false,   "texture",  nothing, never,       true,   false,   flat,    {}},
    });
}();
// clang-format on

static_assert(
    [] {
        for (size_t row = 0; row < k_input_traits.size(); ++row)
            if (k_input_traits[row].kind != row)
                return false;
        return k_input_traits.size() == std::variant_size_v<ChannelInput>;
    }(),
    "each kind of input has its row, in the order of ChannelInput");

template <class Kind>
inline constexpr const InputTraits& k_traits = k_input_traits[k_kind<Kind>];

constexpr const InputTraits& traits_of(const ChannelInput& input) {
    return k_input_traits[input.index()];
}

/// Returns the input with that name in the table, for a directive or `--channel`; nullopt for any other name.
std::optional<ChannelInput> generated_input(std::string_view name);

/// Returns the files that the input is read from.
std::span<const std::filesystem::path> input_files(const ChannelInput& input);

/// Returns the index of the pass that draws the input; null if it is not a pass's output.
const size_t* source_pass(const ChannelInput& input);
size_t* source_pass(ChannelInput& input);

// The channels of a pass: what `iChannelN` reads and how it is sampled.

/// `iChannel0` … `iChannel9`, as in the VS Code extension; ShaderToy has the first four.
inline constexpr int k_channel_count = 10;
inline constexpr int k_site_channel_count = 4;

struct Channel {
    ChannelInput input = Noise{};
    Sampling sampling = k_texture_sampling;
    SourceLocation where{}; ///< the directive that set the input; empty if none did
};

using Channels = std::array<Channel, k_channel_count>;

} // namespace tidemark::scene
