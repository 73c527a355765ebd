// `capture --lens`: draws the numbers of a lens instead of the picture.

#include "base/error.hpp"
#include "cli/capture_run.hpp"
#include "host/requests.hpp"
#include "lab/lens.hpp"
#include "media/file_samples.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <utility>

namespace tidemark::cli {

using namespace host;

namespace {

/// Returns the error with the lens before the reason.
Error refused(const std::string& lens, const Error& error) {
    return {error.code, fmt::format("--lens {}: {}", lens, lab::reason_of(error))};
}

template <class T>
Result<T> or_refused(const std::string& lens, Result<T> result) {
    if (!result)
        return fail(refused(lens, result.error()));
    return result;
}

} // namespace

Result<void> plan_lens_output(CapturePlan& plan) {
    const CaptureOptions& options = plan.options;
    if (options.lens.empty())
        return {};
    const auto refuse = [&](std::string why) {
        return fail(refused(options.lens, {ErrorCode::usage, std::move(why)}));
    };
    TRY(or_refused(options.lens, lab::parse_lens(options.lens)));
    if (precision_of(options.scene) != glsl::Precision::single)
        return refuse("not in double precision: remove --precision");
    if (plan.keeps_alpha() || plan.encoding.transfer == image::Transfer::linear)
        return refuse("its picture has neither alpha nor light: remove --alpha and --transfer");
    plan.encoding.lens_numbers = plan.to_picture_files() && plan.output.pattern().extension() == ".exr";
    if (!plan.encoding.lens_numbers) {
        plan.area.written = lab::largest_legend_extent(plan.area.written);
        return {};
    }
    if (options.encoding.depth.empty())
        plan.encoding.depth = image::SampleDepth::f32;
    plan.encoding.transfer = image::Transfer::data;
    return {};
}

Result<void> plan_lens(CapturePlan& plan) {
    if (plan.options.lens.empty())
        return {};
    const std::string& text = plan.options.lens;
    lab::Lens lens = TRY(or_refused(text, lab::parse_lens(text)));
    lens.pass = plan.frames.state.pass;
    plan.drawing.lens = TRY(or_refused(text, lab::make_lens(plan.scene, lens)));
    if (!plan.encoding.lens_numbers)
        plan.area.written = lab::legend_extent(*plan.drawing.lens, plan.frames.state.extent);
    return {};
}

Result<LensDrawing> LensDrawing::create(const CapturePlan& plan, render::Renderer& plain) {
    lab::LensPlan planned = *plan.drawing.lens;
    if (planned.lens.name == lab::LensName::cost) // with a context the weights of the device are known
        planned = TRY(
            or_refused(plan.options.lens, lab::make_lens(plan.scene, planned.lens, lab::device_weights())));
    LensDrawing drawing(plan, std::move(planned), plain);
    const lab::LensPlan& lens = drawing.lens_;
    if (!lens.drawn)
        return drawing;
    drawing.drawn_ = std::make_unique<render::Renderer>(TRY(or_refused(
        plan.options.lens, render::Renderer::create(*lens.drawn, lab::lens_options(lens, plain.extent())))));
    drawing.stepper_.emplace(*drawing.drawn_, plan.states);
    return drawing;
}

Result<image::Image> LensDrawing::draw(int frame, const Interrupt& interrupt) {
    if (stepper_)
        stepper_->draw(frame);
    numbers_ = TRY(or_refused(plan_->options.lens,
                              lab::read_lens(lens_, {*plain_, drawn_.get(), inputs_of(plan_->states(frame))},
                                             [&] { return !interrupt.requested(); })));
    if (plan_->encoding.lens_numbers)
        return lab::raw_numbers(numbers_);
    const bool alone = plan_->to_picture_files() && !plan_->output.numbered() && !plan_->area.sheet;
    image::Image picture =
        lab::draw_lens(lens_, numbers_, alone ? std::nullopt : std::optional(plan_->area.written));
    return plan_->encoding.depth == image::SampleDepth::u8 ? std::move(picture)
                                                           : image::in_floats(std::move(picture));
}

nlohmann::ordered_json LensDrawing::report(bool all) const {
    const lab::LensPlan& plan = lens_;
    const lab::LensSummary summary = lab::summary_of(plan, numbers_);
    const auto finite = [](double number) {
        return std::isfinite(number) ? nlohmann::ordered_json(number) : nlohmann::ordered_json();
    };
    nlohmann::ordered_json report{{"lens", lab::to_string(plan.lens)},
                                  {"title", plan.title},
                                  {"unit", plan.unit},
                                  {"basis", lab::to_string(plan.basis)},
                                  {"min", finite(summary.least)},
                                  {"median", finite(summary.median)},
                                  {"p99", finite(summary.p99)},
                                  {"max", finite(summary.most)},
                                  {"pixels", summary.pixels},
                                  {"numbers", summary.numbers},
                                  {"marked", summary.marked},
                                  {"nan", summary.nan},
                                  {"infinite", summary.infinite}};
    for (size_t i = 0; i < plan.classes.size(); ++i)
        report["classes"][std::string(plan.classes[i].name)] = summary.classes[i];
    if (plan.lens.name == lab::LensName::branch)
        report["parting"] = summary.parting;
    if (!plan.more_basis.empty())
        report["weights"] = plan.more_basis;
    if (!numbers_.note.empty())
        report["note"] = numbers_.note;
    if (!all)
        return report;
    auto& values = report["values"] = nlohmann::ordered_json::array();
    for (size_t i = 0; i < numbers_.marks.size(); ++i)
        for (int k = 0; k < numbers_.components; ++k)
            values.push_back(numbers_.marks[i] == lab::LensNumbers::Mark::absent
                                 ? nlohmann::ordered_json()
                                 : finite(double(numbers_.at(i, k))));
    return report;
}

} // namespace tidemark::cli
