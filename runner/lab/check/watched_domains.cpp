#include "lab/check/watched_domains.hpp"

#include "image/census.hpp"
#include "lab/trace/shader_words.hpp"

namespace tidemark::lab {

Result<WatchedDomains> WatchedDomains::link(const PassPreview& preview, const PassText& pass, Extent part) {
    constexpr std::string_view k_what = "the text that reports its domains";
    for (const auto scope : {glsl::DomainScope::everything, glsl::DomainScope::floats}) {
        glsl::DomainWatch watch = glsl::watch_domains(*pass.text, pass.facts, scope);
        auto linked = StandIn::link(preview, watch.text, k_what, part);
        if (linked)
            return WatchedDomains(std::move(watch), *std::move(linked));
        if (scope == glsl::DomainScope::floats)
            return fail(std::move(linked.error()));
    }
    return fail(ErrorCode::load, std::string(k_what));
}

void WatchedDomains::set(int site, double value, const PixelGrid& grid, size_t objectives) {
    stand_in_.set(watch_.number_uniform, site);
    stand_in_.set(watch_.value_uniform, value);
    stand_in_.set(watch_.stride_uniform, grid.stride);
    stand_in_.set(watch_.left_uniform, grid.left);
    stand_in_.set(watch_.down_uniform, grid.down);
    stand_in_.set(watch_.count_uniform, double(objectives));
    stand_in_.set(watch_.width_uniform, stand_in_.target().extent().width);
}

std::vector<uint32_t> WatchedDomains::draw(const PassPreview& preview, const PixelGrid& grid) {
    const ShaderWords words(std::max<size_t>(watch_.words(), 1));
    set(-1, 0, grid, watch_.objectives.size());
    gl::clear(stand_in_.target()); // pixels that this draw discards would keep an earlier draw's values
    stand_in_.draw(preview);
    return words.read();
}

image::Image WatchedDomains::picture_with(const PassPreview& preview, const PixelGrid& grid, size_t site,
                                          double value) {
    const ShaderWords ignored(std::max<size_t>(watch_.words(), 1));
    set(int(site), value, grid, 0);
    stand_in_.draw(preview);
    return stand_in_.picture();
}

bool WatchedDomains::finite() const {
    return !image::census(stand_in_.picture()).first_non_finite;
}

glm::ivec2 WatchedDomains::pixel(const PixelGrid& grid, uint32_t number) const {
    const int width = stand_in_.target().extent().width;
    return {grid.left + grid.stride * (int(number) % width), grid.down + grid.stride * (int(number) / width)};
}

} // namespace tidemark::lab
