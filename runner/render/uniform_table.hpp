// Maps the active uniforms of a linked program to the rows of `scene::k_host_uniforms`, channels' structs and
// knobs, once, and computes their values for each frame.
#pragma once

#include "base/extent.hpp"
#include "render/channel_textures.hpp"
#include "render/frame_state.hpp"
#include "render/gl_program.hpp"
#include "render/pass_state.hpp"
#include "scene/host_uniforms.hpp"
#include "scene/scene.hpp"

#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace tidemark::render {

class UniformTable {
public:
    UniformTable() = default;
    /// The scene's knobs, and whether other hosts' names count: on ShaderToy a uniform `time` is zero, and so
    /// it is here.
    struct Names {
        const std::vector<scene::Knob>& knobs;
        bool other_hosts = false; ///< accepts names of the VS Code extension, glslsandbox.com and glslViewer
    };
    /// `absent_too`: also sets uniforms that the program does not have, to measure the cost.
    UniformTable(const gl::Reflection& reflection, const Names& names, bool absent_too = false);

    size_t size() const { return entries_.size(); }

    /// Computes the values of the active uniforms.
    UniformValues values(const FrameInputs& inputs, Extent resolution, const ChannelFacts& channels,
                         const std::vector<scene::Knob>& knobs) const;
    /// Receives a uniform, its numbers, and how many of them an array element has.
    using Take = std::function<void(const gl::Uniform&, std::span<const double>, size_t width)>;
    void hand_over(const UniformValues& values, const Take& take) const;
    void upload(const gl::Program& program, const UniformValues& values) const;

    /// Returns whether a uniform may change in the next frame without user input.
    bool follows_clock() const;

private:
    enum class Source {
        host,
        struct_size,   ///< iChN.size, iChannel[N].resolution
        struct_time,   ///< iChN.time, iChannel[N].time
        struct_loaded, ///< iChN.loaded
        knob
    };
    /// Returns the source of a member of that channel's struct; nothing for other uniforms.
    static std::optional<Source> struct_member(std::string_view name, size_t channel);

    struct Entry {
        gl::Uniform uniform;
        Source source;
        size_t index = 0; ///< of the row, the knob or the channel

        const scene::HostUniform& row() const { return scene::k_host_uniforms[index]; }
    };
    static UniformNumbers host_value(const Entry& entry, const FrameInputs& inputs, Extent resolution,
                                     const ChannelFacts& channels);
    std::vector<Entry> entries_;
};

} // namespace tidemark::render
