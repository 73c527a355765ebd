#include "cli/view/stage.hpp"

#include "base/try.hpp"
#include "cli/trial.hpp"
#include "cli/view/wall_clock.hpp"

#include <algorithm>
#include <limits>

namespace tidemark::cli {
namespace {

constexpr auto k_settled = glsl::Specialise::invariant_uniforms;

/// Idle time before background optimisation: a user who edits a scene saves and drags more often.
constexpr double k_shortest_rest_seconds = 2;
/// Idle time for each second of compiling. A trial compiles the scene twice, which is then a tenth of the
/// idle time.
constexpr double k_rest_per_second_of_compiling = 20;

} // namespace

Result<Stage> Stage::create(platform::SharedContext context, scene::Scene scene,
                            const render::RenderOptions& options, const render::FrameInputs& first) {
    TRY(context.make_current());
    const double start = now_seconds();
    auto renderer = TRY(render::Renderer::create(std::move(scene), options));
    renderer.warm_up(first);
    const double compiling = now_seconds() - start;
    const bool worth_settling = worth_trying(renderer, k_settled);
    context.leave();
    Stage stage(std::move(context), std::make_unique<render::Renderer>(std::move(renderer)));
    if (worth_settling)
        stage.seconds_to_settle_ =
            std::max(k_shortest_rest_seconds, k_rest_per_second_of_compiling * compiling);
    return stage;
}

Result<Stage> Stage::settle(platform::SharedContext context, const scene::Scene& scene,
                            const render::RenderOptions& options, const render::FrameInputs& shown) {
    TRY(context.make_current());
    render::RenderOptions settled = options;
    settled.specialise = k_settled;
    TrialPlan plan{shown, shown, std::numeric_limits<size_t>::max()};
    plan.first.frame = 0; // buffers begin at frame 0
    plan.first.time = 0;
    plan.first.date = render::later(shown.date, -shown.time);
    plan.in_window = true;
    auto trial = TRY(choose_program(scene, settled, plan));
    if (!trial.share)
        return fail(ErrorCode::check_failed, "the specialised program is no better");
    context.leave();
    Stage stage(std::move(context), std::make_unique<render::Renderer>(std::move(trial.renderer)));
    stage.share_ = trial.share;
    return stage;
}

Stage::~Stage() {
    if (!renderer_)
        return;
    const platform::KeepCurrent current;
    (void)context_.make_current(); // GL objects must be deleted in the context that owns them
    renderer_.reset();
}

} // namespace tidemark::cli
