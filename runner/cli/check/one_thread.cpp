#include "cli/check/one_thread.hpp"

#include "base/try.hpp"
#include "cli/error_json.hpp"
#include "cli/json_dump.hpp"
#include "cli/state_json.hpp"
#include "gl/capabilities.hpp"
#include "platform/headless_context.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cstdlib>

namespace tidemark::cli {
namespace {

Result<image::Image> picture(const scene::Scene& scene, const platform::DeviceChoice& device,
                             const render::FrameState& state) {
    const auto context = TRY(platform::HeadlessContext::create(device));
    return lab::ProbeBench(scene, {}).picture(state);
}

/// Encodes the bit patterns, since JSON has no NaN.
Json bits_of(const image::Image& picture) {
    Json bits = Json::array();
    for (const float sample : picture.f32())
        bits.push_back(std::bit_cast<uint32_t>(sample));
    return bits;
}

} // namespace

Result<ForkedHelper> one_thread_painter(const scene::Scene& scene, const platform::DeviceChoice& device) {
    return ForkedHelper::start([&](const std::string& question, const Tell& tell) {
        ::setenv("LP_NUM_THREADS", "0", 1); // no threads in addition to the calling one
        const auto drawn = picture(scene, device, frame_state_of(parse_json(question)));
        tell(dump(drawn ? bits_of(*drawn) : to_json(drawn.error())));
    });
}

bool counts_threads() {
    return gl::query_capabilities().renderer.starts_with("llvmpipe");
}

Result<image::Image> drawn_by(ForkedHelper& painter, const render::FrameState& state, double seconds) {
    const auto run = TRY(painter.ask(dump(to_json(state)), seconds));
    if (run.timed_out)
        return fail(ErrorCode::timed_out, fmt::format("one thread gave up after {:.3g} s", seconds));
    if (run.output.empty())
        return fail(ErrorCode::load, run.crash);
    const Json bits = parse_json(run.output);
    if (auto error = error_of(bits))
        return fail(*std::move(error));
    image::Image picture(state.extent, 3, image::SampleType::f32);
    std::ranges::transform(bits, picture.f32().begin(),
                           [](const Json& sample) { return std::bit_cast<float>(sample.get<uint32_t>()); });
    return picture;
}

} // namespace tidemark::cli
