#include "cli/view/stage.hpp"

namespace tidemark::cli {

Result<Stage> Stage::create(platform::WindowContext context, scene::Scene scene,
                            const render::RenderOptions& options, const render::FrameInputs& first) {
    if (auto current = context.make_current(); !current)
        return fail(std::move(current.error()));
    auto renderer = render::Renderer::create(std::move(scene), options);
    if (!renderer)
        return fail(std::move(renderer.error()));
    renderer->warm_up(first);
    context.leave();
    return Stage(std::move(context), std::make_unique<render::Renderer>(*std::move(renderer)));
}

Stage::~Stage() {
    if (!renderer_)
        return;
    const platform::KeepCurrent current;
    (void)context_.make_current(); // GL objects are deleted in the context that has them
    renderer_.reset();
}

} // namespace tidemark::cli
