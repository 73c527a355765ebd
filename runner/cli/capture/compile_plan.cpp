#include "cli/capture/compile_plan.hpp"

#include "base/try.hpp"
#include "cli/capture/watchdog.hpp"
#include "cli/console.hpp"
#include "gl/capabilities.hpp"
#include "render/renderer.hpp"

#include <fmt/format.h>

namespace tidemark::cli {
namespace {

/// The size of the tiles; nothing where frames are drawn whole.
Result<std::optional<Extent>> choose_tile(const CapturePlan& plan) {
    const int limit = gl::query_capabilities().largest_target;
    if (plan.tile_side)
        return render::tile_of_side(*plan.tile_side, limit).map([](Extent tile) {
            return std::optional(tile);
        });
    if (plan.output.video())
        return std::nullopt;
    return render::tile_for(plan.drawing.extent, 4 * image::size_of(plan.drawing.samples), limit);
}

/// Where it pays, the faster of two programs; in tiles too large a picture is drawn to draw it for a trial.
Result<Trial> choose_renderer(const CapturePlan& plan, render::RenderOptions drawing) {
    if (!plan.trial || drawing.tile)
        return Trial{TRY(render::Renderer::create(plan.scene, drawing))};
    drawing.specialise = plan.trial->as_far_as;
    auto trial = TRY(choose_program(plan.scene, drawing, plan.trial->frames));
    if (!trial.said.empty())
        say(trial.said);
    return trial;
}

} // namespace

Result<Trial> compile(const CapturePlan& plan, Interrupt& interrupt) {
    const Interrupt::Immediate at_once(interrupt);
    Watchdog watchdog;
    const Watchdog::Watch watch(watchdog, "compiling", plan.timeout);
    const auto tile = TRY(choose_tile(plan));
    render::RenderOptions drawing = plan.drawing;
    drawing.tile = tile;
    auto compiled = TRY(choose_renderer(plan, drawing));
    if (plan.tile_side && !compiled.renderer.tiles())
        return fail(
            ErrorCode::usage,
            fmt::format(
                "--tile: {} must be drawn whole: it is a cube, a pass reads it, or it discards pixels",
                compiled.renderer.shown_pass().name));
    return compiled;
}

} // namespace tidemark::cli
