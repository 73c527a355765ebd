#include "lab/device_difference.hpp"

#include "base/measurement.hpp"
#include "lab/exploration.hpp"
#include "lab/instrumented_pass.hpp"
#include "lab/text_findings.hpp"
#include "media/comparison.hpp"
#include "shader/variation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <list>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <utility>

namespace tidemark::lab {
namespace {

/// A model moves a pixel if a sample changes by this part of what makes two pixels differ.
constexpr double k_moved = 0.5;
/// A model that draws all but this share of the differing pixels as the other device does reproduces it.
constexpr double k_left_over = 0.1;
/// Largest number of causes that are reported for one difference.
constexpr size_t k_most_causes = 3;
/// A cause is named if it moves at least this share of the pixels in addition to those before it.
constexpr double k_least_gain = 0.02;
/// The share of a model's gain that it loses if it moves all pixels that do not differ.
constexpr double k_cost_elsewhere = 0.1;
/// Lines that are named of one cause.
constexpr size_t k_most_lines = 3;
/// The lines that are named carry this share of what all lines do.
constexpr double k_share_of_lines = 0.8;
constexpr size_t k_most_parts = 8; ///< in which lines are left out, after halves and quarters
/// A buffer's sample comes near the other device's if this part of the difference is left.
constexpr double k_nearer = 0.1;
/// If a text explains this share of the difference, no other text is tried.
constexpr double k_all_met = 0.98;
/// Seconds after which no other model is tried, and no line narrowed down.
constexpr double k_enough_seconds = 60;
/// Seconds of a pass above which no model is tried: some thirty drawings follow, each up to four times
/// slower.
constexpr double k_slow_pass_seconds = 1;
constexpr int k_least_side = 24; ///< pictures are not made smaller than this

/// Beside the bits of glsl::SwiftShaderPart: the texels of mipmaps (ExactMipmaps).
constexpr int k_mipmap_contents = 1 << glsl::k_swiftshader_parts;

/// A part of SwiftShader's arithmetic, as a cause.
struct SwiftPart {
    int part;
    const char* name;
    const char* says;
};
/// In the order in which they are left out: parts with the smallest effect first.
constexpr SwiftPart k_swift_parts[] = {
    {k_mipmap_contents, "mipmaps", "mipmaps rounded to the nearest byte, not upwards"},
    {int(glsl::SwiftShaderPart::weights), "filter", "SwiftShader's weights and positions of texture filters"},
    {int(glsl::SwiftShaderPart::derivatives), "derivatives", "one derivative for a block of 2x2 pixels"},
    {int(glsl::SwiftShaderPart::products), "rounding",
     "SwiftShader's roundings of dot products, matrices, quotients and mix"},
    {int(glsl::SwiftShaderPart::mipmaps), "mipmaps", "SwiftShader's choice of the mipmap"},
    {int(glsl::SwiftShaderPart::outside), "undefined",
     "SwiftShader's values where a function or an operator is undefined"},
    {int(glsl::SwiftShaderPart::order), "order", "a variable read before the same expression sets it"},
    {int(glsl::SwiftShaderPart::powers), "functions", "SwiftShader's pow, exp and log"},
    {int(glsl::SwiftShaderPart::arcs), "functions",
     "SwiftShader's atan, asin and acos, and functions of constants"},
    {int(glsl::SwiftShaderPart::sines), "sine", "SwiftShader's sines, which are up to 1.5e-4 off"},
};
static_assert(std::size(k_swift_parts) == glsl::k_swiftshader_parts + 1);

/// The effect of a model on the pixels in question.
struct Effect {
    DeviceCause cause;
    Mask moved{};         ///< grown
    size_t elsewhere = 0; ///< moved pixels that do not differ, nor do their neighbours
    Mask together{};      ///< what all effects of SwiftShader's arithmetic draw as the other device does
    // To change fewer places; not of calls outside of a function's domain, whose place is known.
    glsl::VariedArithmetic arithmetic{};
    int mode = 0;
    std::vector<glsl::NodeId> places{};
};

/// Tries models on one pass.
class Explainer {
public:
    Explainer(const PassPreview& preview, const PassText& text, int filters, image::Image here,
              const image::Image& there, PictureKind kind, Mask question, const Stopwatch& watch, bool strict)
        : preview_(&preview), text_(text), here_(std::move(here)), there_(there), kind_(kind), watch_(watch),
          strict_(strict), filters_(filters), question_(std::move(question)),
          near_(grown(question_, here_.extent)), asked_(count(question_)) {}

    /// Stops early when a model reproduces the other device.
    void try_models(const std::vector<Model>& models) {
        for (const Model& model : models)
            for (const glsl::VariationMode& mode : model.arithmetic.modes) {
                if (!has_time() || reproduced())
                    return;
                try_model(model, mode);
            }
    }
    bool reproduced() const {
        return std::ranges::any_of(effects_, [](const Effect& e) { return e.cause.reproduced; });
    }

    /// Draws with SwiftShader's arithmetic. The parts that are needed to draw what the other device drew, or
    /// most of it, are causes.
    void try_swiftshader(ExactMipmaps& mipmaps) {
        int present = mipmaps.any() ? k_mipmap_contents : 0;
        const auto parts_of =
            std::make_shared<const std::vector<int>>(glsl::swiftshader_parts(*text_.text, text_.facts));
        for (const int parts : *parts_of)
            present |= parts;
        if (!mipmaps.any_levels())
            present &= ~int(glsl::SwiftShaderPart::mipmaps);
        std::optional<SwiftDrawing> best, plain;
        int parts = present;
        for (const glsl::SwiftOrder order :
             {glsl::SwiftOrder::driver, glsl::SwiftOrder::text, glsl::SwiftOrder::compiler}) {
            auto drawing = has_time() ? link_swiftshader(present, order) : std::nullopt;
            if (!drawing)
                continue;
            const int used = draw_with_fewest(*drawing, present, mipmaps);
            if (best && drawing->share() < best->share() + k_least_gain)
                continue;
            parts = used;
            plain = std::exchange(best, std::move(drawing));
            if (order == glsl::SwiftOrder::compiler)
                plain.reset(); // what the driver merges is not a cause
            if (best->share() >= k_all_met)
                break;
        }
        if (best && best->share() >= k_least_gain)
            add_swift_effects(*best, plain ? &*plain : nullptr, parts, parts_of, mipmaps);
        mipmaps.use(false);
    }

    /// Tries other values for each call outside of a function's domain.
    void try_undefined() {
        auto watched = WatchedDomains::link(*preview_, text_, here_.extent);
        if (!watched) {
            problem_ = to_string(watched.error());
            return;
        }
        const PixelGrid whole{};
        const std::vector<uint32_t> words = watched->draw(*preview_, whole);
        const auto& sites = watched->watch().sites;
        for (size_t i = 0; i < sites.size(); ++i) {
            const glsl::DomainReading reading = reading_of(watched->watch(), words, i);
            if (reading.count == 0 || place_of_site(*text_.text, sites[i]).empty())
                continue;
            std::string says = domain_sentence(*text_.text, sites[i], reading);
            says = says.substr(0, says.rfind(" ("));
            for (const double value : {std::numeric_limits<double>::quiet_NaN(), 0.0, 1.0}) {
                Effect effect =
                    measured(watched->picture_with(*preview_, whole, i, value), {"undefined", says});
                effect.cause.places = {location_of_site(*text_.text, sites[i])};
                if (effect.cause.moved > 0)
                    effects_.push_back(std::move(effect));
            }
        }
    }

    /// Chooses the effects that move the pixels in question, the best first, and returns the share that they
    /// move together.
    double choose() {
        chosen_.clear();
        Mask covered(question_.size());
        double explained = 0;
        for (const Effect& effect : effects_) {
            if (effect.together.empty())
                continue;
            chosen_.push_back(&effect);
            covered = effect.together;
            explained = share(covered);
        }
        std::ranges::stable_sort(chosen_, std::greater{}, [](const Effect* e) { return e->cause.moved; });
        chosen_.resize(std::min(chosen_.size(), k_most_causes));
        while (chosen_.size() < k_most_causes && explained < k_explained_share) {
            const Effect* best = nullptr;
            double best_gain = k_least_gain;
            for (const Effect& effect : effects_) {
                const double elsewhere = double(effect.elsewhere) / double(question_.size());
                const double gain = share(either(covered, effect.moved)) - explained -
                                    k_cost_elsewhere * elsewhere + (effect.cause.reproduced ? 1 : 0);
                if (gain > best_gain) {
                    best = &effect;
                    best_gain = gain;
                }
            }
            if (!best)
                break;
            covered = either(covered, best->moved);
            explained = best->cause.reproduced ? 1 : share(covered);
            chosen_.push_back(best);
        }
        return explained;
    }

    /// Returns the chosen causes.
    std::vector<DeviceCause> causes() const {
        std::vector<DeviceCause> causes;
        for (const Effect* effect : chosen_)
            causes.push_back(effect->cause);
        return causes;
    }
    /// `preview`: of the same pass. `causes`: begin with those of this pass. `mipmaps`: of the textures that
    /// it reads; null: they stay as they are.
    void find_lines(const PassPreview& preview, std::span<DeviceCause> causes, ExactMipmaps* mipmaps) {
        preview_ = &preview;
        for (size_t i = 0; i < chosen_.size(); ++i)
            if (causes[i].places.empty())
                causes[i].places = lines_of(*chosen_[i], mipmaps);
    }

    const std::string& problem() const { return problem_; }
    bool asked() const { return asked_ > 0; }
    size_t pass() const { return text_.pass; }

private:
    bool has_time() const { return watch_.elapsed().wall < 1000 * k_enough_seconds; }

    /// SwiftShader's arithmetic, linked, and the pixels in question in which it meets the other device.
    struct SwiftDrawing {
        glsl::Variation varied;
        StandIn stand_in;
        int parts;
        glsl::SwiftOrder order;
        size_t asked;
        Mask met{};
        double share() const { return double(count(met)) / double(asked); }
    };

    std::optional<SwiftDrawing> link_swiftshader(int parts, glsl::SwiftOrder order,
                                                 const glsl::MayVary& may = {}) {
        glsl::Variation varied = glsl::vary_like_swiftshader(*text_.text, text_.facts, parts, order, may);
        auto stand_in = StandIn::link(*preview_, varied.text, "a variation of the text");
        if (!stand_in) {
            problem_ = to_string(stand_in.error());
            return std::nullopt;
        }
        stand_in->set(varied.filters_uniform, filters_);
        return SwiftDrawing{std::move(varied), *std::move(stand_in), parts, order, asked_};
    }

    Mask met_with(SwiftDrawing& drawing, int parts, ExactMipmaps& mipmaps) {
        // No mode of a text undoes its order, nor arcs of constants.
        constexpr int k_fixed = int(glsl::SwiftShaderPart::order) | int(glsl::SwiftShaderPart::arcs);
        if (const int undone = drawing.parts & ~parts & k_fixed)
            if (auto other = link_swiftshader(drawing.parts & ~undone, drawing.order))
                return met_with(*other, parts, mipmaps);
        mipmaps.use((parts & k_mipmap_contents) != 0);
        drawing.stand_in.set(drawing.varied.mode_uniform, parts);
        drawing.stand_in.draw(*preview_);
        return met(drawing.stand_in.picture());
    }

    /// Tries first without the weights of filters, which cost most. Returns the parts that meet more.
    int draw_with_fewest(SwiftDrawing& drawing, int parts, ExactMipmaps& mipmaps) {
        constexpr int k_weights = int(glsl::SwiftShaderPart::weights);
        drawing.met = met_with(drawing, parts & ~k_weights, mipmaps);
        if ((parts & k_weights) == 0 || drawing.share() >= k_all_met || !has_time())
            return parts & ~k_weights;
        if (Mask all = met_with(drawing, parts, mipmaps); count(all) > count(drawing.met)) {
            drawing.met = std::move(all);
            return parts;
        }
        return parts & ~k_weights;
    }

    /// Returns the pixels in question that are drawn as on the other device; of a buffer, also those that
    /// come ten times nearer: what the next pass makes of the rest is tried with that pass.
    Mask met(const image::Image& varied) const {
        Mask mask = differing(varied, there_, same_pixel(kind_), kind_);
        const size_t left = size_t(varied.channels), own = size_t(here_.channels),
                     other = size_t(there_.channels);
        const auto is_near = [&](size_t pixel) {
            for (size_t channel = 0; channel < 4; ++channel) {
                const double target = there_.f32()[pixel * other + channel];
                const double before = std::abs(here_.f32()[pixel * own + channel] - target);
                const double after = std::abs(varied.f32()[pixel * left + channel] - target);
                if (!(after <= std::max(same_pixel(kind_), k_nearer * before)))
                    return false;
            }
            return true;
        };
        for (size_t i = 0; i < mask.size(); ++i)
            mask[i] = question_[i] && (!mask[i] || (kind_ == PictureKind::buffer && is_near(i)));
        return mask;
    }

    /// Leaves out parts that are not needed, and adds an effect for each of the others. `plain`: in the
    /// driver's order, if `best` is in the text's; else null. `parts_of`: those of each node.
    void add_swift_effects(SwiftDrawing& best, const SwiftDrawing* plain, int present,
                           const std::shared_ptr<const std::vector<int>>& parts_of, ExactMipmaps& mipmaps) {
        const double enough = double(count(best.met)) - k_least_gain * double(asked_);
        int needed = present;
        for (const SwiftPart& part : k_swift_parts)
            if ((needed & part.part) != 0 && has_time())
                if (Mask met = met_with(best, needed & ~part.part, mipmaps); double(count(met)) >= enough) {
                    needed &= ~part.part;
                    best.met = std::move(met);
                }
        const auto add = [&](DeviceCause cause, const Mask& others, Effect effect) {
            effect.cause = std::move(cause);
            effect.cause.pass = kind_ == PictureKind::image ? "" : preview_->pass().name;
            effect.moved = best.met;
            for (size_t i = 0; i < others.size(); ++i)
                effect.moved[i] = best.met[i] && !others[i]; // the pixels that need it
            effect.cause.moved = share(effect.moved);
            effect.cause.reproduced = best.share() >= k_explained_share;
            effect.together = best.met;
            effects_.push_back(std::move(effect));
        };
        // In some of its places only, with all other parts everywhere.
        const auto with_places = [&](auto is_place) {
            Effect effect;
            effect.mode = needed;
            effect.arithmetic.vary = [=, order = best.order](const auto& text, const auto& facts,
                                                             const auto& may) {
                return glsl::vary_like_swiftshader(text, facts, needed, order,
                                                   [&](glsl::NodeId id) { return !is_place(id) || may(id); });
            };
            std::ranges::copy_if(best.varied.places, std::back_inserter(effect.places), is_place);
            return effect;
        };
        if (plain)
            add({"rounding", "every operation in the order of the text, and none left out"}, plain->met,
                with_places([this](glsl::NodeId id) {
                    return text_.text->tree()[id].kind == glsl::NodeKind::declaration;
                }));
        for (const SwiftPart& part : k_swift_parts) {
            if ((needed & part.part) == 0)
                continue;
            const bool contents = part.part == k_mipmap_contents; // of all look-ups
            const int uses = contents ? int(glsl::SwiftShaderPart::mipmaps) : part.part;
            Effect effect =
                with_places([parts_of, uses](glsl::NodeId id) { return ((*parts_of)[id] & uses) != 0; });
            if (contents)
                effect.arithmetic.vary = [](auto&&...) { return glsl::Variation{}; };
            add({part.name, part.says}, met_with(best, needed & ~part.part, mipmaps), std::move(effect));
        }
        if (needed == 0 && !plain)
            add_without_parts(add, best, enough, *parts_of, mipmaps);
    }

    /// Adds an effect of a text that draws what the other device draws with any functions.
    void add_without_parts(const auto& add, const SwiftDrawing& best, double enough,
                           const std::vector<int>& parts_of, ExactMipmaps& mipmaps) {
        constexpr int k_undefined =
            int(glsl::SwiftShaderPart::products) | int(glsl::SwiftShaderPart::outside);
        const auto is_quotient = [&](glsl::NodeId id) { return (parts_of[id] & k_undefined) == k_undefined; };
        Effect effect;
        effect.arithmetic.vary = [parts = best.parts, order = best.order](const auto& text, const auto& facts,
                                                                          const auto& may) {
            return glsl::vary_like_swiftshader(text, facts, parts, order, may);
        };
        auto quotients = link_swiftshader(best.parts, best.order, is_quotient);
        const auto met_by = [&](int mode) { return double(count(met_with(*quotients, mode, mipmaps))); };
        const bool by_zero = quotients && met_by(0) >= enough && met_by(glsl::k_opposite_quotients) < enough;
        effect.places = by_zero ? quotients->varied.places : best.varied.places;
        add({by_zero ? "undefined" : "rounding",
             by_zero ? "quotients by zero, which are infinite or NaN there"
             : best.order == glsl::SwiftOrder::compiler
                 ? "operations in the order of the text, only known numbers merged"
                 : "every operation drawn in the order of the text, none left out"},
            Mask(question_.size()), std::move(effect));
    }

    double share(const Mask& moved) const {
        return asked_ == 0 ? 0 : double(count(both(question_, moved))) / double(asked_);
    }

    Effect measured(const image::Image& varied, DeviceCause cause) const {
        const Mask moved = differing(here_, varied, k_moved * same_pixel(kind_), kind_);
        Effect effect{std::move(cause), strict_ ? met(varied) : grown(moved, here_.extent)};
        effect.cause.pass = kind_ == PictureKind::image ? "" : preview_->pass().name;
        effect.cause.moved = share(effect.moved);
        effect.cause.reproduced = double(count(differing(varied, there_, same_pixel(kind_), kind_))) <=
                                  k_left_over * double(asked_);
        for (size_t i = 0; i < moved.size(); ++i)
            effect.elsewhere += moved[i] && !near_[i];
        return effect;
    }

    /// Returns nothing if the variation has no places, or if the driver refuses it.
    std::optional<image::Image> picture_with(const glsl::Variation& varied, int mode) {
        if (varied.places.empty())
            return std::nullopt;
        auto stand_in = StandIn::link(*preview_, varied.text, "a variation of the text");
        if (!stand_in) {
            problem_ = to_string(stand_in.error());
            return std::nullopt;
        }
        stand_in->set(varied.mode_uniform, mode);
        stand_in->set(varied.filters_uniform, filters_);
        stand_in->draw(*preview_);
        return stand_in->picture();
    }

    void try_model(const Model& model, const glsl::VariationMode& mode) {
        glsl::Variation varied = model.arithmetic.vary(*text_.text, text_.facts, {});
        const auto picture = picture_with(varied, mode.number);
        if (!picture)
            return;
        Effect effect = measured(*picture, {model.name, mode.name});
        effect.arithmetic = model.arithmetic;
        effect.mode = mode.number;
        effect.places = std::move(varied.places);
        if (effect.cause.moved > 0)
            effects_.push_back(std::move(effect));
    }

    /// Returns up to three lines that carry an effect: it is switched on in ever fewer lines, as long as
    /// those move nearly as many pixels.
    std::vector<SourceLocation> lines_of(const Effect& effect, ExactMipmaps* mipmaps) {
        using Line = std::pair<std::pair<std::string, int>, std::set<glsl::NodeId>>;
        std::map<std::pair<std::string, int>, std::set<glsl::NodeId>> by_line;
        for (const glsl::NodeId id : effect.places) {
            const SourceLocation where = text_.text->spelled(text_.text->tree()[id].word);
            if (!where.file.empty())
                by_line[{where.file, where.line}].insert(id);
        }
        const auto moves = [&](std::span<const Line> some) {
            const auto may = [&](glsl::NodeId id) {
                return std::ranges::any_of(some, [&](const Line& line) { return line.second.contains(id); });
            };
            const auto picture =
                picture_with(effect.arithmetic.vary(*text_.text, text_.facts, may), effect.mode);
            if (!picture)
                return 0.0;
            return strict_ ? share(both(met(*picture), effect.moved)) : measured(*picture, {}).cause.moved;
        };
        std::vector<Line> left(by_line.begin(), by_line.end());
        if (mipmaps)
            mipmaps->use((effect.mode & k_mipmap_contents) != 0);
        for (size_t parts = 2; parts <= std::min(left.size(), k_most_parts) && has_time();) {
            bool smaller = false; // one of the parts was left out
            for (size_t i = 0; i < parts && !smaller && has_time(); ++i) {
                std::vector<Line> rest = left;
                rest.erase(rest.begin() + ptrdiff_t(left.size() * i / parts),
                           rest.begin() + ptrdiff_t(left.size() * (i + 1) / parts));
                smaller = moves(rest) >= k_share_of_lines * effect.cause.moved;
                if (smaller)
                    left = std::move(rest);
            }
            parts = smaller ? 2 : parts < left.size() ? std::min(2 * parts, left.size()) : parts + 1;
        }
        std::vector<SourceLocation> places;
        for (const Line& line : std::span(left).first(std::min(left.size(), k_most_lines)))
            places.push_back({line.first.first, line.first.second});
        return places;
    }

    const PassPreview* preview_;
    const PassText& text_;
    const image::Image here_;
    const image::Image& there_;
    PictureKind kind_;
    const Stopwatch& watch_;
    bool strict_; ///< a model counts where it draws what the other device draws, not where it moves pixels
    int filters_;
    Mask question_, near_;
    size_t asked_;
    std::vector<Effect> effects_;
    std::vector<const Effect*> chosen_; ///< of effects_; valid until a model is tried
    std::string problem_;
};

} // namespace

Result<void> explain(DeviceDifference& difference, ProbeBench& bench, const FrameState& state,
                     const FramePictures& there, OtherDevice other, const SeeCauses& see) {
    const Stopwatch watch;
    const auto here = TRY(bench.passes(state));
    auto texts = read_texts(bench, false);
    if (!texts) {
        difference.problem = "the text cannot be analysed: " + to_string(texts.error());
        return {};
    }
    // SwiftShader's passes, and all with feedback, in the order in which they are drawn, each with the other
    // device's pictures of what it reads, so that each difference is explained where it begins. Else Image
    // first, with the buffers as they are here; where that explains too little, the buffers follow: Image may
    // amplify what they differ by.
    const bool known = other == OtherDevice::swiftshader;
    const bool in_order = known || !there.before.empty();
    if (!in_order)
        std::stable_partition(texts->begin(), texts->end(),
                              [&](const PassText& text) { return text.pass == bench.scene().image_index(); });
    const render::Renderer* const renderer = TRY(bench.renderer(state));
    // The previous frame is then the other device's, except for cubemaps.
    const bool has_cubemap =
        std::ranges::any_of(renderer->plan().passes, [&](const render::PlannedPass& pass) {
            return bench.scene().passes[pass.pass].kind == scene::PassKind::cubemap;
        });
    const auto run_up = in_order && !there.before.empty() && !has_cubemap ? ProbeBench::RunUp::left_out
                                                                          : ProbeBench::RunUp::drawn;
    std::optional<double> least; // of the shares of the passes
    // Lines take long: they are searched when all passes are explained.
    std::list<Explainer> explainers;
    std::vector<std::pair<Explainer*, size_t>> without_lines; // with the number of the first cause
    for (const PassText& text : *texts) {
        const bool is_image = text.pass == bench.scene().image_index();
        const std::string& name = bench.scene().passes[text.pass].name;
        const image::Image *own = picture_of(here, name), *others = picture_of(there.passes, name);
        if (!own || !others || own->extent != others->extent)
            continue;
        const PictureKind kind = is_image ? PictureKind::image : PictureKind::buffer;
        const auto preview = TRY(bench.preview(state, text.pass, run_up));
        const bool is_fed = in_order && use_pictures(*renderer, text.pass, there);
        const image::Image fed = TRY(draw_own(preview, preview.extent()));
        if (is_fed)
            own = &fed;
        const image::Image asked = is_image ? comparable(*own, *others) : *own;
        Explainer& explainer = explainers.emplace_back(
            preview, text, filters_of(*renderer, preview.pass(), text.pass), *own, *others, kind,
            differing(asked, *others, same_pixel(kind), kind), watch, known);
        if (!explainer.asked())
            continue;
        const Stopwatch drawing; // the first drawing included compilation
        TRY(draw_own(preview, preview.extent()));
        if (drawing.elapsed().wall > 1000 * k_slow_pass_seconds &&
            std::min(state.extent.width, state.extent.height) > k_least_side) {
            difference.too_slow = true;
            return {};
        }
        if (known) {
            ExactMipmaps mipmaps(*renderer, text.pass);
            explainer.try_swiftshader(mipmaps);
            explainer.try_models(models_beside_swiftshader());
        } else {
            explainer.try_models(device_models(other != OtherDevice::same_functions));
            if (!explainer.reproduced())
                explainer.try_undefined();
        }
        double explained = explainer.choose();
        if (explained < k_explained_share && !known) {
            explainer.try_models(last_bit_models());
            explained = explainer.choose();
        }
        if (difference.problem.empty())
            difference.problem = explainer.problem();
        if (in_order) {
            least = std::min(least.value_or(1), explained);
            without_lines.emplace_back(&explainer, difference.causes.size());
            std::ranges::move(explainer.causes(), std::back_inserter(difference.causes));
            difference.explained = &text == &texts->back() ? *least : 0;
        } else if (explained > difference.explained) {
            difference.explained = explained;
            difference.causes = explainer.causes();
        } else {
            continue;
        }
        if (see)
            see(difference);
        if (in_order)
            continue;
        explainer.find_lines(preview, difference.causes, nullptr);
        if (difference.explained >= k_explained_share)
            break;
    }
    for (const auto& [explainer, first] : without_lines) {
        const auto preview = TRY(bench.preview(state, explainer->pass(), run_up));
        use_pictures(*renderer, explainer->pass(), there);
        std::optional<ExactMipmaps> mipmaps;
        if (known)
            mipmaps.emplace(*renderer, explainer->pass());
        explainer->find_lines(preview, std::span(difference.causes).subspan(first),
                              mipmaps ? &*mipmaps : nullptr);
        if (mipmaps)
            mipmaps->use(false);
    }
    difference.explained = in_order ? least.value_or(0) : difference.explained;
    difference.begins_earlier = !least && !there.before.empty();
    return {};
}

} // namespace tidemark::lab
