// Imitates the arithmetic of other GPUs and drivers and compares the pictures.

#include "base/error.hpp"
#include "lab/instrumented_pass.hpp"
#include "lab/probed_pictures.hpp"
#include "lab/probes.hpp"
#include "lab/text_findings.hpp"
#include "media/comparison.hpp"
#include "shader/variation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <span>

namespace tidemark::lab {
namespace {

/// Late enough for the arguments of sines to be as large as in typical use.
const FrameState k_state = state_at(10);

struct Mode {
    int number;
    const char* name;
    bool of_devices = true; ///< there are devices that compute so
};

/// A way to rewrite a text, with the modes that it offers.
struct Manner {
    std::function<glsl::Variation(const glsl::ParsedText& text, const glsl::TreeFacts& facts)> vary;
    std::vector<Mode> modes;
};

/// Draws a scene's passes in the modes of rewritten texts and collects the differences.
class PortabilityProbe {
public:
    explicit PortabilityProbe(ProbeBench& bench) : bench_(bench) {}

    /// Fails if a text cannot be rewritten so, or if the driver refuses it.
    Result<void> add(const Manner& manner) {
        const auto texts = TRY(read_texts(bench_, false));
        for (const PassText& pass : texts)
            if (const auto varied = manner.vary(*pass.text, pass.facts); varied.places > 0)
                TRY(compare(pass.pass, varied, manner.modes));
        return {};
    }

    bool asked() const { return asked_; }

    /// Returns the answer, with the largest difference first; `sound` is its text if none is visible.
    Answer answer(const std::string& sound, bool of_sines = false) {
        std::ranges::stable_sort(seen_, std::greater(), &Seen::gap);
        std::vector<std::string> visible, hardly;
        for (const Seen& seen : seen_)
            (seen.gap > k_visible_gap ? visible : hardly).push_back(seen.sentence);
        const bool devices =
            std::ranges::any_of(seen_, [](const Seen& seen) { return seen.of_devices && seen.noticeable; });
        if (visible.empty())
            return {Verdict::pass, sound + ": " + (hardly.empty() ? "the same picture" : listed(hardly))};
        Answer answer{devices ? Verdict::warn : Verdict::note,
                      "the picture changes visibly with " + listed(visible), k_state, std::move(picture_)};
        if (!devices)
            answer.effect = "the picture changes a little with other roundings";
        else
            add_lossy_line(answer, of_sines);
        answer.where->pass = pass_ == bench_.scene().image_index() ? "" : bench_.scene().passes[pass_].name;
        return answer;
    }

private:
    /// Adds the line at which the pixel that is furthest from double loses its digits; `of_sines`: only if a
    /// sine is in that line. Leaves scenes with hashes alone: `hashes` names those.
    void add_lossy_line(Answer& answer, bool of_sines) {
        const auto hashes = bench_.hashes();
        if (!hashes || !hashes->empty())
            return;
        auto plain = bench_.picture(k_state);
        if (!plain)
            return;
        if (const auto lost = where_digits_are_lost(bench_, {10, k_state, *std::move(plain), 0});
            lost && (!of_sines || has_sine(lost->where))) {
            answer.sentence += "; " + lost->sentence;
            add_place(answer, lost->where);
        }
    }

    static bool is_same_line(const SourceLocation& a, const SourceLocation& b) {
        return a.file == b.file && a.line == b.line;
    }
    bool has_sine(const SourceLocation& line) const {
        const auto texts = read_texts(bench_, true);
        return texts && std::ranges::any_of(*texts, [&](const PassText& pass) {
                   for (size_t i = 0; i < pass.text->words().size(); ++i)
                       if (const std::string_view word = pass.text->word(i);
                           (word == "sin" || word == "cos" || word == "tan") &&
                           is_same_line(pass.text->spelled(i), line))
                           return true;
                   return false;
               });
    }

    Result<void> compare(size_t pass, const glsl::Variation& varied, std::span<const Mode> modes) {
        const auto preview = TRY(bench_.preview(k_state, pass));
        auto stand_in = TRY(StandIn::link(preview, varied.text, "a variation of the text"));
        asked_ = true;
        std::vector<image::Image> others;
        for (const Mode& mode : modes)
            others.push_back(drawn(stand_in, preview, varied, mode.number));
        const image::Image plain =
            varied.mode_uniform.empty() ? as_drawn(stand_in, preview) : drawn(stand_in, preview, varied, 0);
        for (size_t i = 0; i < modes.size(); ++i)
            note(pass, modes[i], plain, others[i]);
        return {};
    }

    static image::Image drawn(StandIn& stand_in, const PassPreview& preview, const glsl::Variation& varied,
                              int mode) {
        stand_in.set(varied.mode_uniform, mode);
        stand_in.draw(preview);
        return stand_in.picture();
    }

    /// Draws the author's text.
    static image::Image as_drawn(const StandIn& stand_in, const PassPreview& preview) {
        stand_in.draw_own(preview);
        return stand_in.picture();
    }

    void note(size_t pass, const Mode& mode, const image::Image& plain, const image::Image& other) {
        const double gap = p99_difference(plain, other);
        if (image::compare(plain, other)->equal())
            return;
        std::string said = fmt::format("{}: {}", mode.name, alikeness(plain, other));
        if (gap > k_visible_gap)
            said += fmt::format(", 1 % of the pixels by {:.2g} or more", gap);
        const bool noticeable = gap > k_noticeable_gap && looks_different(plain, other);
        seen_.push_back({std::move(said), gap, mode.of_devices, noticeable});
        if (gap <= std::max(worst_, k_visible_gap))
            return;
        worst_ = gap;
        pass_ = pass;
        picture_ = image::difference_picture(plain, other, 1);
    }

    ProbeBench& bench_;
    bool asked_ = false;
    /// A mode that changed the bytes.
    struct Seen {
        std::string sentence;
        double gap;
        bool of_devices;
        bool noticeable; ///< a viewer would see it
    };
    std::vector<Seen> seen_;
    double worst_ = 0;
    size_t pass_ = 0;
    std::optional<image::Image> picture_;
};

} // namespace

Result<Answer> ask_sine(ProbeBench& bench) {
    using glsl::SineMode;
    PortabilityProbe probe(bench);
    const Manner sines{glsl::vary_sines,
                       {{int(SineMode::unit_up), "sines a unit in the last place larger"},
                        {int(SineMode::unit_down), "sines a unit smaller"},
                        {int(SineMode::like_nvidia), "a sine like NVIDIA's"}}};
    if (auto done = probe.add(sines); !done)
        return Answer{Verdict::not_applicable, to_string(done.error())};
    if (!probe.asked())
        return Answer{Verdict::not_applicable, "the scene has no sine"};
    return probe.answer("no visible difference with other GPUs' sines", true);
}

Result<Answer> ask_rounding(ProbeBench& bench) {
    PortabilityProbe probe(bench);
    const Manner manners[] = {
        {glsl::vary_inputs, {{1, "iTime, iResolution and iMouse a unit in the last place larger", false}}},
        {glsl::vary_precision, {{0, "everything `precise`", false}}},
        {glsl::vary_contraction, {{1, "fused multiply-add"}}},
        {glsl::vary_order, {{0, "sums added in reverse order", false}}},
        {glsl::vary_rounding, {{1, "quotients, roots, powers and logarithms a unit off"}}},
    };
    std::vector<std::string> left_out;
    std::string why;
    for (const Manner& manner : manners)
        if (auto done = probe.add(manner); !done) {
            left_out.emplace_back(manner.modes[0].name);
            why = to_string(done.error());
        }
    if (!probe.asked())
        return Answer{Verdict::not_applicable, left_out.empty() ? "nothing is computed" : why};
    Answer answer = probe.answer("no visible difference with other roundings");
    if (!left_out.empty())
        answer.sentence += "; not tried, as the driver or the text does not allow it: " + listed(left_out);
    return answer;
}

Result<bool> depends_on_contraction(ProbeBench& bench, const std::set<std::string>& functions) {
    PortabilityProbe probe(bench);
    TRY(probe.add({[&](const glsl::ParsedText& text, const glsl::TreeFacts& facts) {
                       return glsl::vary_contraction_in(text, facts, functions);
                   },
                   {{1, "fused multiply-add"}}}));
    return probe.asked() && probe.answer({}).verdict != Verdict::pass;
}

Result<Answer> ask_mediump(ProbeBench& bench) {
    PortabilityProbe probe(bench);
    if (auto done = probe.add(
            {glsl::vary_halves, {{1, "sums and products in half floats, as with `mediump` on phones"}}});
        !done)
        return Answer{Verdict::not_applicable, to_string(done.error())};
    if (!probe.asked())
        return Answer{Verdict::not_applicable, "nothing is `mediump` or `lowp`"};
    return probe.answer("no visible difference in half floats");
}

} // namespace tidemark::lab
