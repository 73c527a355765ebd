// Searches for situations in which a scene's numbers break: random moments, knobs and mouse positions and
// those from the text's numbers, then steps towards the edge of each function's domain and towards the other
// outcome of each comparison, guided by an instrumented text, then the pixels of a large picture around the
// nearest ones. The search is deterministic up to its time limit. Finding nothing proves nothing.
#pragma once

#include "lab/instrumented_pass.hpp"
#include "lab/probe_bench.hpp"
#include "lab/text_findings.hpp"
#include "shader/domain_watch.hpp"

#include <glm/vec2.hpp>

#include <string>
#include <vector>

namespace tidemark::lab {

/// Searches once per bench; later calls return the stored result, which the bench owns.
Result<const Explored*> explore(ProbeBench& bench);

// Draws a pass with an instrumented text that reports its domains (shader/domain_watch.hpp). A context
// must be current.

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

// Finds calls outside a function's domain and measures how much of the picture depends on their value. A
// context must be current.

/// A moment and the pixels that are drawn of it.
struct PictureView {
    FrameState state;
    PixelGrid grid{};
};

/// Returns three ordinary views, the middle of a picture of odd size, whose pixel is on both axes, and up to
/// six in which the search saw floats leave a function's domain.
Result<std::vector<PictureView>> usual_views(ProbeBench& bench);

/// An undefined call and its effect.
struct UndefinedCall {
    std::string sentence;
    std::string what; ///< "pow of a negative number"
    SourceLocation place;
    size_t pass = 0; ///< index in the scene
    glsl::DomainSite site{};
    double percent = 0; ///< of the pixels that depend on it; 0: none
    FrameState where;
    image::Image picture; ///< the difference that those pixels show
};

/// Returns the undefined calls of the views, the most visible first. `texts` come from read_texts with
/// as_written = false. Fails if the driver refuses the instrumented text.
Result<std::vector<UndefinedCall>> find_undefined(ProbeBench& bench, const std::vector<PassText>& texts,
                                                  const std::vector<PictureView>& views);

} // namespace tidemark::lab
