#include "window/lens_view.hpp"

#include "scene/knob.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tidemark::window {
namespace {

/// Returns whether the buffers that the frame reads are known.
bool is_known(const LensMoment& moment) {
    return !moment.has_feedback || moment.buffers;
}

using Order = LensOrder::Kind;
using PixelMark = lab::LensNumbers::Mark;

/// Shortest pauses between updates while time runs.
constexpr double k_facts_pause_seconds = 1, k_lines_pause_seconds = 5;
constexpr size_t k_front_points = 5;

} // namespace

void LensView::choose(const std::string& text) {
    direction_ = 0;
    fresh_ = true;
    drawn_.reset();
    if (text.empty()) {
        chosen_.clear();
        lens_.reset();
        refusal_.clear();
        message_ = "lens off";
        return;
    }
    auto lens = lab::parse_lens(text);
    if (lens)
        return choose_lens(*lens);
    chosen_ = text;
    lens_.reset();
    refusal_ = lab::reason_of(lens.error());
    message_ = fmt::format("lens {}: {}", chosen_, refusal_);
}

void LensView::choose_lens(const lab::Lens& lens) {
    chosen_ = lab::to_string(lens);
    if (lens.place) {
        place_ =
            (lens.place->file.empty() ? "" : lens.place->file + ":") + fmt::format("{}", lens.place->line);
        variable_ = lens.name == lab::LensName::branch && lens.number > 0 ? fmt::format("{}", lens.number)
                                                                          : lens.variable;
    }
    lens_ = lens;
    refusal_ = no_lens_;
    if (const auto known = refused_.find(chosen_); known != refused_.end())
        refusal_ = known->second;
    message_ = fmt::format("lens {}: {}", chosen_,
                           refusal_.empty() ? lab::form_of(lens.name).description : refusal_);
}

void LensView::step(int direction) {
    // Off, then the lenses that need no line, then the one with a line that was chosen before.
    std::vector<std::string> cycle{""};
    for (size_t i = 0; i < lab::k_lenses; ++i)
        if (const lab::LensForm& form = lab::form_of(lab::LensName(i)); form.line != lab::LineUse::required)
            cycle.emplace_back(form.name);
    auto at = std::ranges::find(cycle, chosen_);
    if (at == cycle.end()) { // with a line: it follows the others
        cycle.push_back(chosen_);
        at = cycle.end() - 1;
    }
    const auto count = std::ptrdiff_t(cycle.size());
    auto place = at - cycle.begin();
    const std::string skipped = std::exchange(message_, {});
    do {
        place = (place + direction + count) % count;
    } while (place != 0 && refused_.contains(cycle[size_t(place)]));
    choose(cycle[size_t(place)]);
    if (direction_ = on() ? direction : 0; !skipped.empty())
        message_ = skipped + "\n" + message_;
}

void LensView::turn_knob(const std::string& knob) {
    if (!front_ || front_->knob != knob)
        front_.emplace(overlay::FrontField{knob});
}

void LensView::set_scene(std::shared_ptr<const scene::Scene> scene, std::string refusal) {
    if (std::exchange(scene_, std::move(scene)) == scene_)
        return;
    no_lens_ = std::move(refusal);
    refused_.clear();
    drawn_.reset();
    facts_ = {};
    front_.reset();
    lines_.of.reset();
    buffers_.reset();
    direction_ = 0;
    if (lens_)
        refusal_ = no_lens_;
}

bool LensView::wants_numbers() const {
    return lens_ && refusal_.empty();
}

bool LensView::shows_chosen() const {
    return picture_ && lab::to_string(picture_->plan.lens) == chosen_;
}

bool LensView::wants_buffers() const {
    return (wants_numbers() || status_ || front_) && no_lens_.empty() && !busy();
}

void LensView::keep_buffers(const render::FrameState& state, render::BufferState buffers) {
    buffers_.emplace(state, std::move(buffers));
}

std::optional<render::BufferState> LensView::buffers_for(const render::FrameState& state) const {
    return buffers_ && buffers_->first == state ? std::optional(buffers_->second) : std::nullopt;
}

std::string LensView::front_value(const render::FrameState& state) const {
    if (!front_ || !scene_)
        return "";
    const auto knob = std::ranges::find(scene_->knobs, front_->knob, &scene::Knob::name);
    return knob == scene_->knobs.end() ? "" : to_string(*knob, value_after(*knob, state.knobs));
}

/// A front wants each value once; the status line wants each moment, at intervals while time runs.
bool LensView::facts_wanted(const LensMoment& moment, bool plays, double now) const {
    if (const std::string value = front_value(moment.state);
        !value.empty() && (front_->points.empty() || front_->points.back().value != value))
        return true;
    return status_ && facts_.of != moment.state && (!plays || now - facts_.at > k_facts_pause_seconds);
}

std::optional<LensOrder> LensView::next(const LensMoment& moment, bool plays, double now) const {
    if (!moment.scene || !no_lens_.empty())
        return std::nullopt;
    const bool numbers = wants_numbers() && is_known(moment) && drawn_ != moment.state;
    const bool facts = is_known(moment) && facts_wanted(moment, plays, now);
    const bool lines =
        lines_.numbers.open && (!lines_.of || (*lines_.of != moment.state && !moment.has_feedback &&
                                               (!plays || now - lines_.at > k_lines_pause_seconds)));
    if (numbers && !shows_chosen())
        return LensOrder{Order::numbers, *lens_, moment};
    // In turn, so that a moment that always changes starves none.
    const std::array wanted{numbers, facts, lines};
    for (size_t i = 1; i <= wanted.size(); ++i)
        if (const size_t kind = (size_t(last_) + i) % wanted.size(); wanted[kind])
            return LensOrder{Order(kind), lens_.value_or(lab::Lens{}), moment};
    return std::nullopt;
}

bool LensView::is_stale(const LensOrder& order, const LensMoment& moment) const {
    if (order.moment.scene != moment.scene)
        return true;
    if (order.kind != Order::numbers && wants_numbers() && is_known(moment) && !shows_chosen())
        return true; // a lens that was just chosen comes first
    if (order.kind != Order::numbers)
        return order.kind == Order::facts ? !status_ && !front_ : !lines_.numbers.open;
    if (chosen_ != lab::to_string(order.lens))
        return true;
    // A proof that is being refined ends when the moment changes.
    const bool refining = picture_ && !picture_->numbers.complete &&
                          picture_->plan.lens.name == order.lens.name && order.moment.state != moment.state;
    return order.lens.name == lab::LensName::proof && refining;
}

void LensView::take(LensPicture picture) {
    if (picture.numbers.complete)
        direction_ = 0;
    picture_ = std::move(picture);
    target_.reset();
    fresh_ = true;
}

void LensView::refuse(const LensOrder& order, const Error& error) {
    if (order.kind == Order::hot_lines) {
        lines_.numbers.lines.clear();
        lines_.numbers.note = lab::reason_of(error);
        return;
    }
    const std::string name = lab::to_string(order.lens);
    refused_[name] = lab::reason_of(error);
    if (name != chosen_) // another lens was chosen meanwhile
        return;
    refusal_ = refused_[name];
    message_ = fmt::format("lens {}: {}", name, refusal_);
    if (direction_ != 0)
        step(direction_);
}

void LensView::take(const FrameFacts& facts, const LensOrder& order, double now) {
    facts_.numbers = facts;
    facts_.at = now;
    const std::string value = front_value(order.moment.state);
    if (value.empty() || (!front_->points.empty() && front_->points.back().value == value))
        return;
    double milliseconds = facts.milliseconds;
    if (!(milliseconds > 0) && !front_->points.empty()) // no pass reads the knob, so nothing was drawn
        milliseconds = front_->points.back().milliseconds;
    front_->points.push_back({value, milliseconds, facts.error.value_or(std::nan(""))});
    if (front_->points.size() > k_front_points)
        front_->points.erase(front_->points.begin());
}

void LensView::take(LensAnswer answer, double now) {
    const LensOrder& order = answer.order;
    last_ = order.kind;
    if (order.moment.scene != scene_)
        return;
    auto* const picture = std::get_if<LensPicture>(&answer.result);
    const bool complete = !picture || picture->numbers.complete;
    if (order.kind == Order::facts)
        facts_.of = order.moment.state;
    if (order.kind == Order::hot_lines) {
        lines_.of = order.moment.state;
        lines_.at = now;
    }
    if (const auto* const error = std::get_if<Error>(&answer.result)) {
        if (order.kind == Order::facts)
            facts_.numbers.reset();
        else
            refuse(order, *error);
    } else if (const auto* const facts = std::get_if<FrameFacts>(&answer.result)) {
        take(*facts, order, now);
    } else if (picture && chosen_ == lab::to_string(order.lens)) {
        drawn_ = complete ? std::optional(order.moment.state) : std::nullopt;
        take(std::move(*picture));
    } else if (auto* const hot = std::get_if<lab::HotLines>(&answer.result)) {
        const render::FrameState counted = counted_state(order.moment);
        lines_.numbers.lines.clear();
        for (lab::HotLine& line : hot->lines)
            lines_.numbers.lines.push_back(
                {std::move(line.where), std::move(line.text), line.share, lab::share_words(line.share)});
        lines_.numbers.note =
            fmt::format("{:.0f} weighted operations per pixel, frame {} in {}x{}", hot->operations,
                        counted.frame, counted.extent.width, counted.extent.height);
    }
}

bool LensView::follow(const LensMoment& moment, bool plays, double now,
                      const std::function<Result<host::SharedContext>()>& make_context,
                      const std::function<void()>& wake) {
    bool changed = false;
    if (worker_)
        while (auto answer = worker_->take()) {
            take(*std::move(answer), now);
            changed = true;
        }
    if (worker_ && running_ && worker_->busy() && is_stale(*running_, moment))
        worker_->cancel();
    if (busy())
        return changed;
    auto order = next(moment, plays, now);
    const bool waited = std::exchange(waits_, !is_known(moment));
    changed = changed || waited != waits_;
    running_.reset();
    if (!order)
        return changed;
    if (!worker_) {
        auto context = make_context();
        if (!context) {
            no_lens_ = context.error().message;
            refusal_ = lens_ ? no_lens_ : "";
            return true;
        }
        worker_ = std::make_unique<LensWorker>(*std::move(context), wake);
    }
    running_ = *order;
    worker_->start(*std::move(order));
    return changed;
}

void LensView::stop() {
    if (worker_)
        worker_->stop();
}

const gl::RenderTarget* LensView::target() {
    if (!wants_numbers() || !shows_chosen())
        return nullptr;
    if (!target_) {
        gl::Texture texture = gl::make_texture(picture_->map.extent, GL_RGBA8, 1);
        gl::upload(texture, 0, GL_RGBA, GL_UNSIGNED_BYTE, picture_->map.bytes);
        target_ = gl::attach(std::move(texture));
    }
    return &*target_;
}

std::optional<overlay::LensField> LensView::field(const std::optional<std::array<int, 2>>& pixel) const {
    if (!on())
        return std::nullopt;
    overlay::LensField field;
    field.title = lens_ ? fmt::format("{}: {}", chosen_, lab::form_of(lens_->name).description) : chosen_;
    field.refusal = refusal_;
    if (!refusal_.empty())
        return field;
    if (!shows_chosen()) {
        field.progress = waits_ ? "waits for the next frame: the scene reads its last one" : "drawing";
        return field;
    }
    const auto& [plan, numbers, summary, range, map] = *picture_;
    field.title = plan.title;
    field.basis = lab::basis_line(plan);
    if (!numbers.complete)
        field.progress = lab::share_words(double(summary.numbers) / double(summary.pixels)) + " known";
    for (const lab::LegendEntry& entry : lab::legend_of(plan, summary, numbers))
        field.entries.push_back({entry.box, entry.words});
    constexpr int k_colours = 64;
    for (int i = 0; i < k_colours && plan.classes.empty(); ++i) {
        const double part = double(i) / (k_colours - 1);
        const auto grey = uint8_t(std::lround(255 * part));
        field.bar.push_back(numbers.components == 1 ? lab::lens_colour(part)
                                                    : std::array<uint8_t, 3>{grey, grey, grey});
    }
    field.low = lab::legend_number(range.low);
    field.high = lab::legend_number(range.high);
    if (!pixel)
        return field;
    const size_t at = size_t((*pixel)[1]) * size_t(numbers.extent.width) + size_t((*pixel)[0]);
    field.pointer = fmt::format("{},{}: ", (*pixel)[0], (*pixel)[1]);
    if (numbers.marks[at] == PixelMark::absent) {
        field.pointer += numbers.complete ? plan.absent : "not known yet";
        return field;
    }
    if (!plan.classes.empty()) {
        field.pointer += plan.classes[std::min(size_t(numbers.at(at)), plan.classes.size() - 1)].name;
        return field;
    }
    for (int k = 0; k < numbers.components; ++k)
        field.pointer += fmt::format("{}{}", k > 0 ? ", " : "", overlay::number_text(numbers.at(at, k)));
    if (numbers.components == 1 && !plan.unit.empty())
        field.pointer += " " + plan.unit;
    if (numbers.marks[at] == PixelMark::marked)
        field.pointer += ", " + plan.marked;
    else if (numbers.components == 1 && std::isfinite(numbers.at(at)))
        field.mark = lab::place_on_bar(plan, range, double(numbers.at(at)));
    return field;
}

overlay::LensChooser LensView::chooser() const {
    overlay::LensChooser chooser{.place = place_, .variable = variable_};
    for (size_t i = 0; i < lab::k_lenses; ++i) {
        const lab::LensForm& form = lab::form_of(lab::LensName(i));
        const std::string text(form.name);
        const auto known = refused_.find(text);
        chooser.choices.push_back({.name = text,
                                   .description = std::string(form.description),
                                   .refusal = known == refused_.end() ? no_lens_ : known->second,
                                   .takes_line = form.line != lab::LineUse::none,
                                   .needs_line = form.line == lab::LineUse::required,
                                   .second = std::string(form.second)});
        if (chosen_ == text || chosen_.starts_with(text + ":"))
            chooser.chosen = i;
    }
    return chooser;
}

std::string LensView::status(std::optional<double> milliseconds) const {
    std::string text = milliseconds ? fmt::format("{:.4g} ms a frame", *milliseconds) : "";
    const auto add = [&](const std::string& words) { text += (text.empty() ? "" : "  ") + words; };
    if (!no_lens_.empty()) {
        add(no_lens_);
        return text;
    }
    if (!facts_.numbers) {
        add("comparing with double");
        return text;
    }
    const FrameFacts& facts = *facts_.numbers;
    if (facts.error)
        add(fmt::format("error against double: RMSE {:.3g}/255, worst {:.3g}/255 at {},{}", *facts.error,
                        facts.worst, facts.worst_at[0], facts.worst_at[1]));
    else
        add("no error against double: " + facts.no_error);
    if (facts.run_out)
        add(fmt::format("rays out of steps: {}", *facts.run_out));
    add(fmt::format("NaN: {}", facts.nan));
    return text;
}

} // namespace tidemark::window
