#include "render/uniform_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::render {
namespace {

/// Accepts any numeric type that an author declares, but a matrix only for a matrix, and never a sampler.
bool can_hold(GLenum type, const scene::HostUniform& row) {
    if (row.type == "mat4")
        return type == GL_FLOAT_MAT4 || type == GL_DOUBLE_MAT4;
    return gl::is_number(type);
}

} // namespace

UniformTable::UniformTable(const gl::Reflection& reflection, const Names& names, bool absent_too) {
    const std::vector<scene::Knob>& knobs = names.knobs;
    for (const gl::Uniform& uniform : reflection.uniforms) {
        const auto knob = std::ranges::find(knobs, uniform.name, &scene::Knob::name);
        const scene::HostUniform* row = scene::find_host_uniform(uniform.name, names.other_hosts);
        if (knob != knobs.end())
            entries_.push_back({uniform, Source::knob, size_t(knob - knobs.begin())});
        else if (row && row->image && can_hold(uniform.type, *row))
            entries_.push_back({uniform, Source::host, size_t(row->value)});
        for (size_t i = 0; i < size_t(scene::k_channel_count); ++i)
            if (const auto source = struct_member(uniform.name, i))
                entries_.push_back({uniform, *source, i});
    }
    if (!absent_too)
        return;
    const auto absent = [&](std::string_view name, GLenum type, Source source, size_t index) {
        if (!name.empty() && !reflection.has(name)) // GL ignores values for location -1
            entries_.push_back({{std::string(name), type, 1, -1}, source, index});
    };
    for (const scene::HostUniform& row : scene::k_host_uniforms) {
        const GLenum type = row.type == "mat4" ? GL_FLOAT_MAT4 : GL_FLOAT_VEC4;
        if (row.image)
            absent(row.name, type, Source::host, size_t(row.value));
        for (const std::string_view other : row.other_names)
            if (names.other_hosts)
                absent(other, type, Source::host, size_t(row.value));
    }
    for (size_t i = 0; i < knobs.size(); ++i)
        absent(knobs[i].name, GL_FLOAT_VEC4, Source::knob, i);
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

UniformNumbers UniformTable::host_value(const Entry& entry, const FrameInputs& inputs, Extent resolution,
                                        const ChannelFacts& channels) {
    // In a scene promoted to double iTime is exact.
    if (entry.row().value == scene::HostValue::time_low && entry.uniform.type == GL_DOUBLE)
        return {0};
    return value_of(entry.row().value, inputs, resolution, channels);
}

UniformValues UniformTable::values(const FrameInputs& inputs, Extent resolution, const ChannelFacts& channels,
                                   const std::vector<scene::Knob>& knobs) const {
    const auto numbers_of = [&](const Entry& entry) -> UniformNumbers {
        switch (entry.source) {
        case Source::host: return host_value(entry, inputs, resolution, channels);
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
        const bool is_array = entry.source == Source::host && entry.row().length > 0;
        return is_array ? component_count(entry.row()) : all;
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
        return entry.source == Source::host ? entry.row().follows == scene::Follows::clock
                                            : entry.source == Source::struct_time;
    });
}

} // namespace tidemark::render
