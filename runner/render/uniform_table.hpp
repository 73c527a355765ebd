// Which of ShaderToy's uniforms a linked program really has, found once, and their values for each frame.
#pragma once

#include "base/extent.hpp"
#include "gl/program.hpp"
#include "render/channel_textures.hpp"
#include "render/frame_inputs.hpp"
#include "render/uniform_numbers.hpp"
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
    /// Of a scene, and whose names it goes by beside ours: a text of ShaderToy's that declares `time` has a
    /// zero there on the site, and has one here.
    struct Names {
        const std::vector<scene::Knob>& knobs;
        bool other_hosts = false; ///< those of the VS Code extension, glslsandbox.com and glslViewer
    };
    /// `absent_too`: hands over what the program has no uniform for as well, to measure what that would cost.
    UniformTable(const gl::Reflection& reflection, const Names& names, bool absent_too = false);

    size_t size() const { return entries_.size(); }

    /// Of the active uniforms and no others.
    UniformValues values(const FrameInputs& inputs, Extent resolution, const ChannelFacts& channels,
                         const std::vector<scene::Knob>& knobs) const;
    /// Each uniform with its numbers, and how many of them an element of an array has.
    using Take = std::function<void(const gl::Uniform&, std::span<const double>, size_t width)>;
    void hand_over(const UniformValues& values, const Take& take) const;
    void upload(const gl::Program& program, const UniformValues& values) const;

    /// Whether some uniform may have another value in the next frame although nobody did anything.
    bool follows_clock() const;

private:
    enum class Source {
        resolution,
        time,
        time_low, ///< what binary32 leaves of the time
        time_delta,
        frame,
        frame_rate,
        mouse,
        relative_mouse, ///< 0 to 1 across the picture
        mouse_button,
        date,
        sample_rate,
        channel_time,
        channel_resolution,
        struct_size,   ///< iChN.size, iChannel[N].resolution
        struct_time,   ///< iChN.time, iChannel[N].time
        struct_loaded, ///< iChN.loaded
        camera,
        view,
        orbit,
        orbit_pan,
        knob
    };
    /// What the member of a channel's struct tells; nothing for other uniforms.
    static bool takes(GLenum type, Source source);
    static bool is_matrix(Source source) { return source == Source::camera || source == Source::view; }
    static std::optional<Source> struct_member(std::string_view name, size_t channel);

    struct Entry {
        gl::Uniform uniform;
        Source source;
        size_t index = 0; ///< of the knob or the channel
    };
    std::vector<Entry> entries_;
};

} // namespace tidemark::render
