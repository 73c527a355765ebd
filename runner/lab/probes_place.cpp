// Checks unusual camera positions of scenes with known hits: under the surface, far away, along the horizon,
// and at the far plane. Moves the orbit camera of a scene that declares iCamera, or its knob camera_position.

#include "base/error.hpp"
#include "lab/probed_rays.hpp"
#include "lab/probes.hpp"
#include "lab/scene_numbers.hpp"
#include "media/image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

namespace tidemark::lab {
namespace {

const scene::Knob* knob_of(const scene::Scene& scene, std::string_view name) {
    const auto found = std::ranges::find(scene.knobs, name, &scene::Knob::name);
    return found == scene.knobs.end() ? nullptr : &*found;
}

bool has_orbit_camera(const scene::Scene& scene) {
    return scene.image().text.text().find("iCamera") != std::string::npos;
}

FrameState moved(const scene::Knob& position, const glm::dvec3& by) {
    scene::KnobValue value = position.value;
    for (int i = 0; i < 3; ++i)
        value[size_t(i)] += by[i];
    FrameState state = typical_view();
    state.knobs = {scene::setting_of(position, value)};
    return state;
}

/// Returns a view `distance` units away from the camera's place; nothing if the camera cannot be moved.
std::optional<FrameState> away(const ProbeBench& bench, double distance) {
    if (const scene::Knob* position = knob_of(bench.scene(), "camera_position"))
        return moved(*position, {distance, 0, distance});
    if (!has_orbit_camera(bench.scene()))
        return std::nullopt;
    FrameState state = typical_view();
    state.camera = render::OrbitCamera{.distance = 10 + distance};
    return state;
}

std::vector<FrameState> below_and_above(const ProbeBench& bench) {
    std::vector<FrameState> states;
    if (const scene::Knob* position = knob_of(bench.scene(), "camera_position")) {
        for (const double height : {-3.0, -30.0, 1e3, 1e5})
            states.push_back(moved(*position, {0, height, 0}));
        return states;
    }
    for (const double distance : {0.01, 1.0}) {
        states.push_back(typical_view());
        states.back().camera = render::OrbitCamera{.distance = distance};
    }
    for (const double elevation : {-20.0, -89.9, 89.9}) {
        states.push_back(typical_view());
        states.back().camera = render::OrbitCamera{.elevation = elevation};
    }
    return states;
}

/// Describes what is wrong with the picture or the hits; empty if nothing is.
Result<std::string> broken(ProbeBench& bench, const FrameState& state) {
    const auto passes = TRY(bench.passes(state));
    for (const PassPicture& pass : passes)
        if (const size_t count = image::census(pass.picture).non_finite(); count > 0)
            return fmt::format("{} samples of {} are NaN or infinite", count, pass.pass);
    const auto hits = TRY(bench.hits(state));
    const double lost = unanswered(hits);
    return lost > 0 ? fmt::format("{:.3g} % of the distances are NaN, infinite or negative", lost)
                    : std::string();
}

std::string place_of(const FrameState& state) {
    return state.knobs.empty() ? fmt::format("--camera {},{},{}", state.camera.azimuth,
                                             state.camera.elevation, state.camera.distance)
                               : to_string(state.knobs);
}

/// Finds the distance up to which rays hit the same in float and double.
Result<Answer> how_far(ProbeBench& bench) {
    double good = 0;
    for (const double distance : {1e1, 1e2, 1e3, 1e4, 1e5, 1e6}) {
        const FrameState state = *away(bench, distance);
        const auto wrong = TRY(broken(bench, state));
        if (!wrong.empty())
            return Answer{fault(bench), place_of(state) + ": " + wrong, state};
        const auto both = float_mismatch(bench, state);
        if (!both)
            return Answer{Verdict::pass,
                          "no NaN or infinity below, above and to 1e6 units away; cannot be drawn in double"};
        if (both->mismatched_percent <= k_same) {
            good = distance;
            continue;
        }
        const bool kept = good >= bench.promises().space_horizon;
        return Answer{
            kept ? Verdict::pass : fault(bench),
            fmt::format(
                "float and double agree to {:g} units away; at {:g} units {:.3g} % of the rays hit something "
                "else in float",
                good, distance, both->mismatched_percent),
            state, both->map};
    }
    return Answer{Verdict::pass,
                  "float and double agree to 1e6 units away; no NaN or infinity below and high above"};
}

/// Returns views that show the horizon: between 5 % and 95 % of the rays hit.
Result<std::vector<FrameState>> views_of_the_horizon(ProbeBench& bench) {
    std::vector<FrameState> views;
    std::vector<FrameState> candidates;
    if (has_orbit_camera(bench.scene()))
        for (const double elevation : {0.0, 0.1, 1.0, 3.0}) {
            candidates.push_back(state_at(10, k_ray_extent));
            candidates.back().camera = render::OrbitCamera{.elevation = elevation};
        }
    else
        for (int y = 1; y < k_ray_extent.height; y += 3)
            candidates.push_back(with_mouse(render::Mouse::clicked({k_ray_extent.width / 2, y}, false),
                                            state_at(10, k_ray_extent)));
    for (const FrameState& candidate : candidates) {
        const auto hits = TRY(bench.hits(candidate));
        const double met = percent(hits, [&](size_t i) { return hits.distance[i] >= 0; });
        if (met > 5 && met < 95)
            views.push_back(candidate);
    }
    return views;
}

/// Returns a view of odd height whose middle row is exactly level, if the camera can be set so.
std::optional<FrameState> level_view(const scene::Scene& scene) {
    FrameState state = state_at(10, {k_ray_extent.width, k_ray_extent.height + 1});
    if (has_orbit_camera(scene)) {
        state.camera = render::OrbitCamera{.elevation = 0};
        return state;
    }
    const scene::Knob* turn = knob_of(scene, "default_turn");
    if (!turn)
        return std::nullopt;
    state.knobs = {scene::setting_of(*turn, {turn->value[0], 0.5, 0, 0})};
    return state;
}

} // namespace

namespace {

/// Counts of rays at one distance from their starts.
struct FarAway {
    size_t ended = 0;      ///< the march ends before this distance
    size_t known = 0;      ///< in real arithmetic, by bounds
    size_t not_finite = 0; ///< of the known: NaN or infinite in float
    size_t off = 0;        ///< of the known: a different distance in float

    double off_percent() const { return 100.0 * double(off) / double(known); }
};

FarAway far_away(FieldOnRays& field, double units) {
    constexpr double k_off = 0.01; // of the distance, and of the march's longest
    FarAway seen;
    for (size_t ray = 0; ray < field.rays(); ++ray) {
        const auto in_float = field.in_float(ray, units);
        const auto exact = in_float ? field.exact(ray, units) : std::nullopt;
        seen.ended += !in_float;
        if (!exact)
            continue;
        ++seen.known;
        seen.not_finite += !std::isfinite(*in_float);
        seen.off += std::abs(*in_float - *exact) > k_off * (std::abs(*exact) + field.longest(ray));
    }
    return seen;
}

/// Checks the distance along the rays of a camera that cannot be moved.
Result<Answer> along_the_rays(ProbeBench& bench) {
    auto field = FieldOnRays::create(bench, typical_view());
    if (!field || field->rays() == 0)
        return Answer{Verdict::not_applicable,
                      "no iCamera and no knob camera_position to move, and no ray whose field is known"};
    double good = 0;
    for (const double units : {1e1, 1e2, 1e3, 1e4, 1e5, 1e6}) {
        const FarAway seen = far_away(*field, units);
        if (seen.known == 0)
            return Answer{good > 0 ? Verdict::pass : Verdict::not_applicable,
                          fmt::format("float and double agree to {:g} units along the rays; further out {}",
                                      good,
                                      seen.ended == field->rays() ? "no ray is marched"
                                                                  : "the field cannot be bounded")};
        if (seen.not_finite > 0)
            return Answer{fault(bench),
                          fmt::format("{:g} units along {} of {} rays the distance is NaN or infinite", units,
                                      seen.not_finite, seen.known)};
        if (seen.off_percent() <= k_same) {
            good = units;
            continue;
        }
        return Answer{
            good >= bench.promises().space_horizon ? Verdict::pass : fault(bench),
            fmt::format("float and double agree to {:g} units along the rays; at {:g} units {:.3g} % of "
                        "the distances are off by more than 1 % in float",
                        good, units, seen.off_percent())};
    }
    return Answer{Verdict::pass, "float and double agree to 1e6 units along the rays"};
}

} // namespace

Result<Answer> ask_places(ProbeBench& bench) {
    if (!bench.has_hits())
        return without_hits(bench);
    if (!away(bench, 0))
        return along_the_rays(bench);
    for (const FrameState& state : below_and_above(bench)) {
        const auto wrong = TRY(broken(bench, state));
        if (!wrong.empty())
            return Answer{fault(bench), place_of(state) + ": " + wrong, state};
    }
    return how_far(bench);
}

Result<Answer> ask_grazing(ProbeBench& bench) {
    if (!bench.has_hits())
        return without_hits(bench);
    auto views = TRY(views_of_the_horizon(bench));
    const size_t turned = views.size();
    if (const auto level = level_view(bench.scene()))
        views.push_back(*level);
    if (views.empty())
        return Answer{Verdict::not_applicable, "the horizon is not visible at any mouse height"};
    for (const FrameState& view : views)
        if (const double lost = unanswered(TRY(bench.hits(view))); lost > 0)
            return Answer{fault(bench),
                          fmt::format("{:.3g} % of the distances are NaN, infinite or negative", lost), view};
    return running_out_answer(bench, TRY(most_running_out(bench, views)),
                              fmt::format("{} views of the horizon{}", views.size(),
                                          views.size() > turned ? ", one with level rays" : ""),
                              "grazing");
}

namespace {

struct FarPlane {
    double distance;
    std::string name;
    const scene::Knob* knob; ///< none: a definition

    void move(FrameState& state, double to) const {
        if (knob)
            state.knobs = {scene::setting_of(*knob, {to, 0, 0, 0})};
        else
            state.definitions = {{name, fmt::format("{:.9g}", to)}};
    }
};

/// Returns whether a march ends at that distance.
bool is_limit(const PassFunction& function, double number) {
    return std::ranges::any_of(function.loops(), [&](const proof::MarchingLoop& loop) {
        if (!loop.limited())
            return false;
        const proof::Instruction& far = function.function().instructions[loop.far];
        return far.op == proof::Op::constant && std::bit_cast<float>(far.immediate) == float(number);
    });
}

/// Returns the knob far_distance, or the only definition whose value is the distance at which the march ends.
std::optional<FarPlane> far_plane(ProbeBench& bench) {
    if (const scene::Knob* knob = knob_of(bench.scene(), "far_distance"))
        return FarPlane{knob->value[0], knob->name, knob};
    const auto& function = bench.image_function();
    std::vector<DefinedNumber> found;
    if (function)
        for (DefinedNumber& each : defined_numbers(bench.scene()))
            if (is_limit(*function, each.value))
                found.push_back(std::move(each));
    if (found.size() != 1)
        return std::nullopt;
    return FarPlane{found[0].value, found[0].name, nullptr};
}

} // namespace

/// Moves the far plane by a thousandth, which may only change hits beyond it.
Result<Answer> ask_far(ProbeBench& bench) {
    if (!bench.has_hits())
        return without_hits(bench);
    const auto far = far_plane(bench);
    if (!far)
        return Answer{Verdict::not_applicable,
                      "no knob far_distance to move, and no definition that limits the march"};
    double most = -1, beyond = 0;
    Answer answer;
    for (FrameState view : usual_views()) {
        const auto before = bench.hits(view);
        far->move(view, 1.001 * far->distance);
        const auto after = bench.hits(view);
        if (!before)
            return fail(before.error());
        if (!after) // for example a whole number, which cannot move by a thousandth
            return Answer{Verdict::not_applicable,
                          "the limit of the march cannot be moved: " + to_string(after.error())};
        const double last = far->distance * (1 - 1e-6);
        const double flickers = percent(*before, [&](size_t i) {
            const double one = before->distance[i], other = after->distance[i];
            const bool near = (one >= 0 && one < last) || (other >= 0 && other < last);
            return near && !(std::abs(one - other) <= std::max(one, other) / view.extent.height);
        });
        beyond +=
            percent(*before, [&](size_t i) { return before->distance[i] > far->distance * (1 + 1e-6); });
        if (flickers <= most)
            continue;
        most = flickers;
        answer.where = view;
    }
    answer.sentence = fmt::format(
        "{:.3g} % of the rays hit something else nearer than the far plane when it moves by a thousandth",
        most);
    if (beyond > 0)
        answer.sentence += "; some hit something beyond it";
    answer.verdict = most > k_same || beyond > 0 ? fault(bench) : Verdict::pass;
    if (answer.verdict == Verdict::pass)
        answer.where.reset();
    return answer;
}

} // namespace tidemark::lab
