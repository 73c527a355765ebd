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

using Mode = glsl::VariationMode;
using Manner = glsl::VariedArithmetic;

/// Draws a scene's passes in the modes of rewritten texts and collects the differences.
class PortabilityProbe {
public:
    explicit PortabilityProbe(ProbeBench& bench) : bench_(bench) {}

    /// Fails if a text cannot be rewritten so, or if the driver refuses it.
    Result<void> add(const Manner& manner) {
        const auto texts = TRY(read_texts(bench_, false));
        for (const PassText& pass : texts)
            if (const auto varied = manner.vary(*pass.text, pass.facts, {}); !varied.places.empty())
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
        auto plain = bench_.picture(k_state), truth = bench_.picture(k_state, glsl::Precision::promoted);
        if (!plain || !truth)
            return;
        if (const auto lost =
                where_digits_are_lost(bench_, {10, k_state, *std::move(plain), *std::move(truth), 0});
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
        const VariedPictures pictures = TRY(draw_varied(preview, varied, modes));
        asked_ = true;
        for (size_t i = 0; i < modes.size(); ++i)
            note(pass, modes[i], pictures.plain, pictures.others[i]);
        return {};
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
    PortabilityProbe probe(bench);
    if (auto done = probe.add(glsl::varied_sines()); !done)
        return Answer{Verdict::not_applicable, to_string(done.error())};
    if (!probe.asked())
        return Answer{Verdict::not_applicable, "the scene has no sine"};
    return probe.answer("no visible difference with other GPUs' sines", true);
}

Result<Answer> ask_rounding(ProbeBench& bench) {
    PortabilityProbe probe(bench);
    std::vector<std::string> left_out;
    std::string why;
    for (const Manner& manner : glsl::varied_roundings())
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
    TRY(probe.add({[&](const glsl::ParsedText& text, const glsl::TreeFacts& facts, const glsl::MayVary&) {
                       return glsl::vary_contraction(text, facts, [&](glsl::NodeId id) {
                           const glsl::NodeId function = text.tree().around(id, glsl::NodeKind::function);
                           return function != glsl::k_no_node &&
                                  functions.contains(std::string(text.word_of(function)));
                       });
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
