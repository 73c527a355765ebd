// The textures behind a scene's channels: each distinct input is made or loaded once, and only when a
// linked program reads it.
#pragma once

#include "base/result.hpp"
#include "gl/texture.hpp"
#include "scene/channel.hpp"

#include <vector>

namespace tidemark::render {

class ChannelTextures {
public:
    /// Index of the texture that `channel` reads, made when it is the first to do so. Fails when its picture
    /// cannot be read or is larger than the driver takes.
    Result<size_t> require(const scene::Channel& channel);

    /// What iChannelResolution tells of a channel whose texture nobody reads: the size of the picture or
    /// noise that a directive put there, zeros where nothing did. A picture is loaded for it.
    Result<Extent> size_of(const scene::Channel& channel);

    const gl::Texture& operator[](size_t index) const { return textures_[index].texture; }

private:
    struct Entry {
        scene::ChannelInput input;
        bool vflip;
        bool mipmaps;
        gl::Texture texture;
    };
    std::vector<Entry> textures_;
};

/// The GL sampler of a channel.
gl::SamplerHandle make_sampler(const scene::Sampling& sampling);

} // namespace tidemark::render
