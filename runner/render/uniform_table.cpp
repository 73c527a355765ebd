#include "render/uniform_table.hpp"

#include "scene/host_uniforms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace tidemark::render {
namespace {

UniformNumbers resolutions_of(const ChannelFacts& channels) {
    UniformNumbers numbers{};
    for (const ChannelFact& channel : channels)
        numbers.append(channel.resolution.begin(), channel.resolution.end());
    return numbers;
}

UniformNumbers times_of(const ChannelFacts& channels) {
    UniformNumbers numbers{};
    for (const ChannelFact& channel : channels)
        numbers.append(&channel.time, &channel.time + 1);
    return numbers;
}

UniformNumbers elements_of(const glm::mat4& matrix) {
    UniformNumbers numbers{};
    numbers.append(&matrix[0][0], &matrix[0][0] + 16);
    return numbers;
}

} // namespace

UniformTable::UniformTable(const gl::Reflection& reflection, const Names& names, bool absent_too) {
    const std::vector<scene::Knob>& knobs = names.knobs;
    constexpr std::pair<std::string_view, Source> k_names[] = {
        {"iResolution", Source::resolution},
        {"iTime", Source::time},
        {scene::k_time_low_uniform, Source::time_low},
        {"iTimeDelta", Source::time_delta},
        {"iFrame", Source::frame},
        {"iFrameRate", Source::frame_rate},
        {"iMouse", Source::mouse},
        {"iDate", Source::date},
        {"iSampleRate", Source::sample_rate},
        {"iChannelTime", Source::channel_time},
        {"iChannelResolution", Source::channel_resolution},
        {scene::k_camera_uniform, Source::camera},
        {scene::k_view_uniform, Source::view},
        {scene::k_orbit_uniform, Source::orbit},
        {scene::k_orbit_pan_uniform, Source::orbit_pan},
        {scene::k_mouse_button_uniform, Source::mouse_button},
    };
    constexpr std::pair<std::string_view, Source> k_names_of_others[] = {
        // The VS Code extension and glslsandbox.com fill these if a text declares them, …
        {"resolution", Source::resolution},
        {"time", Source::time},
        {"mouse", Source::relative_mouse},
        // … and glslViewer fills these.
        {"u_resolution", Source::resolution},
        {"u_time", Source::time},
        {"u_mouse", Source::mouse},
        {"u_frame", Source::frame},
        {"u_delta", Source::time_delta},
        {"u_date", Source::date},
    };
    const auto is_knob = [&](std::string_view name) {
        return std::any_of(knobs.begin(), knobs.end(),
                           [&](const scene::Knob& knob) { return knob.name == name; });
    };
    std::vector<std::pair<std::string_view, Source>> known(std::begin(k_names), std::end(k_names));
    if (names.other_hosts)
        known.insert(known.end(), std::begin(k_names_of_others), std::end(k_names_of_others));
    for (const gl::Uniform& uniform : reflection.uniforms) {
        for (const auto& [name, source] : known)
            if (uniform.name == name && takes(uniform.type, source) && !is_knob(name))
                entries_.push_back({uniform, source});
        for (size_t i = 0; i < knobs.size(); ++i)
            if (uniform.name == knobs[i].name)
                entries_.push_back({uniform, Source::knob, i});
        for (size_t i = 0; i < size_t(scene::k_channel_count); ++i)
            if (const auto source = struct_member(uniform.name, i))
                entries_.push_back({uniform, *source, i});
    }
    if (!absent_too)
        return;
    const auto absent = [&](std::string_view name, Source source, size_t index = 0) {
        const GLenum type = is_matrix(source) ? GL_FLOAT_MAT4 : GL_FLOAT_VEC4;
        if (!reflection.has(name)) // GL ignores values for location -1
            entries_.push_back({{std::string(name), type, 1, -1}, source, index});
    };
    for (const auto& [name, source] : known)
        absent(name, source);
    for (size_t i = 0; i < knobs.size(); ++i)
        absent(knobs[i].name, Source::knob, i);
}

/// Accepts any numeric type that an author declares, but a matrix only for a matrix, and never a sampler.
bool UniformTable::takes(GLenum type, Source source) {
    if (is_matrix(source))
        return type == GL_FLOAT_MAT4 || type == GL_DOUBLE_MAT4;
    return gl::is_number(type);
}

std::optional<UniformTable::Source> UniformTable::struct_member(std::string_view name, size_t channel) {
    std::string_view member;
    for (const std::string& structure :
         {fmt::format("iCh{}.", channel), fmt::format("iChannel[{}].", channel)})
        if (name.starts_with(structure))
            member = name.substr(structure.size());
    if (member == "size" || member == "resolution")
        return Source::struct_size;
    if (member == "time")
        return Source::struct_time;
    if (member == "loaded")
        return Source::struct_loaded;
    return std::nullopt;
}

UniformValues UniformTable::values(const FrameInputs& inputs, Extent resolution, const ChannelFacts& channels,
                                   const std::vector<scene::Knob>& knobs) const {
    const auto numbers_of = [&](const Entry& entry) -> UniformNumbers {
        switch (entry.source) {
        case Source::resolution: return {double(resolution.width), double(resolution.height), 1};
        case Source::time: return {inputs.time};
        // In a scene promoted to double iTime is exact.
        case Source::time_low:
            return {entry.uniform.type == GL_DOUBLE ? 0 : inputs.time - double(float(inputs.time))};
        case Source::time_delta: return {inputs.time_delta};
        case Source::frame: return {double(inputs.frame)};
        case Source::frame_rate: return {inputs.frame_rate};
        case Source::mouse: return {inputs.mouse.x, inputs.mouse.y, inputs.mouse.z, inputs.mouse.w};
        case Source::relative_mouse:
            return {inputs.mouse.x / std::max(1.0, double(resolution.width)),
                    inputs.mouse.y / std::max(1.0, double(resolution.height))};
        case Source::date:
            return {double(inputs.date.year), double(inputs.date.month), double(inputs.date.day),
                    inputs.date.seconds};
        case Source::sample_rate: return {k_sample_rate};
        case Source::channel_time: return times_of(channels);
        case Source::channel_resolution: return resolutions_of(channels);
        case Source::camera: return elements_of(inputs.camera);
        case Source::view: return elements_of(inputs.view);
        case Source::orbit: return {inputs.orbit.x, inputs.orbit.y, inputs.orbit.z, inputs.orbit.w};
        case Source::orbit_pan: return {inputs.orbit_pan.x, inputs.orbit_pan.y, inputs.orbit_pan.z};
        case Source::mouse_button: return {inputs.mouse_button.x, inputs.mouse_button.y, 0, 0};
        case Source::struct_size: return UniformNumbers(channels[entry.index].resolution);
        case Source::struct_time: return {channels[entry.index].time};
        case Source::struct_loaded: return {channels[entry.index].loaded ? 1.0 : 0.0};
        case Source::knob: return UniformNumbers(value_after(knobs[entry.index], inputs.knobs));
        }
        return {};
    };
    UniformValues values;
    values.reserve(entries_.size());
    for (const Entry& entry : entries_) // uniforms that the program lacks must not cause a redraw
        values.push_back(entry.uniform.location < 0 ? UniformNumbers{0} : numbers_of(entry));
    return values;
}

void UniformTable::upload(const gl::Program& program, const UniformValues& values) const {
    hand_over(values, [&](const gl::Uniform& uniform, std::span<const double> all, size_t width) {
        gl::set_uniform(program, uniform, all, width);
    });
}

void UniformTable::hand_over(const UniformValues& values, const Take& take) const {
    // Element width as ShaderToy declares the array, whatever the author declares.
    const auto width_of = [](const Entry& entry, size_t all) -> size_t {
        return entry.source == Source::channel_time         ? 1
               : entry.source == Source::channel_resolution ? 3
                                                            : all;
    };
    for (size_t i = 0; i < entries_.size(); ++i) {
        const std::span<const double> all = values[i];
        take(entries_[i].uniform, all, width_of(entries_[i], all.size()));
    }
}

bool UniformTable::follows_clock() const {
    return std::any_of(entries_.begin(), entries_.end(), [](const Entry& entry) {
        if (entry.uniform.location < 0)
            return false;
        switch (entry.source) {
        case Source::time:
        case Source::time_low:
        case Source::time_delta:
        case Source::frame:
        case Source::frame_rate:
        case Source::date:
        case Source::channel_time:
        case Source::struct_time: return true;
        default: return false;
        }
    });
}

} // namespace tidemark::render
