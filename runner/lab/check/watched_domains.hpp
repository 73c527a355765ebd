// A pass that watches its domains (glsl/instrument/domains.hpp), drawn in its place. A context must be
// current.
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
    /// `part`: the size of what is drawn of the pass. Where the driver refuses the text with all of it
    /// watched, the functions of floats are.
    static Result<WatchedDomains> link(const PassPreview& preview, const PassText& pass, Extent part);

    const glsl::DomainWatch& watch() const { return watch_; }

    /// What the sites met and how near the objectives came.
    std::vector<uint32_t> draw(const PassPreview& preview, const PixelGrid& grid);
    /// What the pass shows where that site gives `value` outside of its domain, and all others 0.
    image::Image picture_with(const PassPreview& preview, const PixelGrid& grid, size_t site, double value);
    /// What the last draw made.
    bool finite() const;
    /// Where in the picture a pixel is that the buffer numbers.
    glm::ivec2 pixel(const PixelGrid& grid, uint32_t number) const;

private:
    WatchedDomains(glsl::DomainWatch watch, StandIn stand_in)
        : watch_(std::move(watch)), stand_in_(std::move(stand_in)) {}
    void set(int site, double value, const PixelGrid& grid, size_t objectives);

    glsl::DomainWatch watch_;
    StandIn stand_in_;
};

} // namespace tidemark::lab
