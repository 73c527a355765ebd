#include "cli/capture/compile_plan.hpp"

#include "base/doing.hpp"
#include "base/try.hpp"
#include "cli/capture/watchdog.hpp"
#include "cli/console.hpp"
#include "gl/capabilities.hpp"
#include "render/renderer.hpp"

#include <fmt/format.h>

namespace tidemark::cli {
namespace {

/// Returns the size of the tiles; nothing if frames are drawn whole.
Result<std::optional<Extent>> choose_tile(const CapturePlan& plan) {
    const int limit = gl::query_capabilities().largest_target;
    if (plan.tile_side)
        return render::tile_of_side(*plan.tile_side, limit).map([](Extent tile) {
            return std::optional(tile);
        });
    const bool whole = plan.output.video() || plan.layers || plan.sheet;
    const auto tile =
        whole ? std::nullopt
              : render::tile_for(plan.drawing.extent, 4 * image::size_of(plan.drawing.samples), limit);
    return plan.exposure.several() && !tile ? plan.drawing.extent : tile; // one tile, shifted for each sample
}

/// Rejects options that the compiled scene does not allow.
Result<void> check_compiled(const CapturePlan& plan, const render::Renderer& renderer) {
    const auto refuse = [](std::string why) { return fail(ErrorCode::usage, std::move(why)); };
    if (plan.tile_side && !renderer.tiles())
        return refuse(fmt::format(
            "--tile: {} must be drawn whole: it is a cube, a pass reads it, or it discards pixels",
            renderer.shown_pass().name));
    if (plan.loop && renderer.tiles() && renderer.tiles()->count() > 1)
        return refuse("--loop: pictures that are drawn in tiles are never in memory as a whole");
    if (plan.exposure.several() && renderer.shown_pass().kind != scene::PassKind::image)
        return refuse("--samples: only Image is a picture; what other passes hold has no mean");
    if (plan.exposure.several() && !renderer.tiles())
        return refuse("--samples: Image cannot be drawn again: a pass reads it, or it discards pixels");
    if (plan.exposure.shutter > 0 && renderer.plan().feedback)
        return refuse("--shutter: this scene reads its own last frame, so that it has no moments between "
                      "two frames; --samples alone smooths its edges");
    return {};
}

/// Returns the faster of two programs if a trial is planned. No trial in tiles: the picture is too
/// large to draw it for one.
Result<Trial> choose_renderer(const CapturePlan& plan, render::RenderOptions drawing) {
    if (!plan.trial || drawing.tile)
        return Trial{TRY(render::Renderer::create(plan.scene, drawing))};
    drawing.specialise = plan.trial->as_far_as;
    auto trial = TRY(choose_program(plan.scene, drawing, plan.trial->frames));
    if (!trial.said.empty())
        say(trial.said);
    return trial;
}

Result<Trial> compile_all(const CapturePlan& plan, Interrupt& interrupt) {
    const Interrupt::Immediate at_once(interrupt);
    Watchdog watchdog;
    const Watchdog::Watch watch(watchdog, {"compiling", plan.timeout});
    const auto tile = TRY(choose_tile(plan));
    render::RenderOptions drawing = plan.drawing;
    drawing.tile = tile;
    auto compiled = TRY(choose_renderer(plan, drawing));
    TRY(check_compiled(plan, compiled.renderer));
    return compiled;
}

} // namespace

Result<Trial> compile(const CapturePlan& plan, Interrupt& interrupt) {
    if (!plan.frames.frames.empty())
        Doing::note_frame(DoingPage::Frame{plan.frames.frames.front(), false});
    return compile_all(plan, interrupt).map_error([&](Error error) {
        if (error.code == ErrorCode::no_memory && !plan.frames.frames.empty())
            error.message += fmt::format(" (before frame {})", plan.frames.frames.front());
        return error;
    });
}

} // namespace tidemark::cli
