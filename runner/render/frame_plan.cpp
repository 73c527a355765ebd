#include "render/frame_plan.hpp"

#include <fmt/format.h>

namespace tidemark::render {

FramePlan plan_frame(const scene::Scene& scene, const std::vector<gl::Reflection>& reflections) {
    FramePlan plan;
    for (size_t i = 0; i < scene.passes.size(); ++i) {
        PlannedPass planned{i, {}};
        for (int channel = 0; channel < scene::k_channel_count; ++channel)
            if (reflections[i].has(fmt::format("iChannel{}", channel)))
                planned.channels.push_back(channel);
        plan.passes.push_back(std::move(planned));
    }
    return plan;
}

} // namespace tidemark::render
