// Draws a pass with an instrumented text that reports its domains (glsl/instrument/domains.hpp). A context
// must be current.
#pragma once

#include "glsl/instrument/domains.hpp"
#include "lab/check/explored.hpp"
#include "lab/check/probe_text.hpp"
#include "lab/trace/stand_in.hpp"

#include <glm/vec2.hpp>

#include <vector>

namespace tidemark::lab {

class WatchedDomains {
public:
    /// Links the instrumented text; `part` is the size to draw. If the driver refuses it with everything
    /// instrumented, only functions of floats are.
    static Result<WatchedDomains> link(const PassPreview& preview, const PassText& pass, Extent part);

    const glsl::DomainWatch& watch() const { return watch_; }

    /// Draws the grid and returns the buffer: what each site reached and how near each objective came.
    std::vector<uint32_t> draw(const PassPreview& preview, const PixelGrid& grid);
    /// Draws the pass with `value` as the result of that site outside its domain, and 0 for all other sites.
    /// `site` may be one past the last: 0 for all.
    image::Image picture_with(const PassPreview& preview, const PixelGrid& grid, size_t site, double value);
    /// Returns whether the last drawn picture is finite.
    bool finite() const;
    /// Returns the place in the picture of a pixel that the buffer numbers.
    glm::ivec2 pixel(const PixelGrid& grid, uint32_t number) const;

private:
    WatchedDomains(glsl::DomainWatch watch, StandIn stand_in)
        : watch_(std::move(watch)), stand_in_(std::move(stand_in)) {}
    void set(int site, double value, const PixelGrid& grid, size_t objectives);

    glsl::DomainWatch watch_;
    StandIn stand_in_;
};

} // namespace tidemark::lab
