// Built-in functions outside of their domain, and 0 / 0: what they give there is another thing on every GPU.
#include "glsl/watch/domains.hpp"
#include "image/compare/difference.hpp"
#include "image/compare/metrics.hpp"
#include "lab/check/probe_text.hpp"
#include "lab/check/probes.hpp"
#include "lab/trace/shader_words.hpp"
#include "lab/trace/stand_in.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <set>

namespace tidemark::lab {
namespace {

/// A GPU may give 0 where others give NaN or another number: the pixels that then differ visibly.
double differing(const image::Image& left, const image::Image& right) {
    return image::compare(left, right, 1.0 / 255)->differing_share();
}

/// Calls whose part in the picture is looked at, in one pass: two pictures each.
constexpr size_t k_most_calls = 16;

std::vector<Situation> situations() {
    const Extent size = Situation().extent;
    return {{.time = 1}, {.time = 0}, {.time = 10, .mouse = glm::ivec2(size.width / 3, size.height / 4)}};
}

/// A call that was undefined, with what hangs on it.
struct Undefined {
    std::string sentence;
    double percent = 0; ///< of the pixels
    Situation where;
    image::Image picture;
};

class DomainProbe {
public:
    DomainProbe(ProbeBench& bench, const PassText& pass)
        : bench_(bench), pass_(pass),
          watch_(glsl::watch_domains(*pass.text, pass.facts, Situation().extent.width)) {}

    Result<std::vector<Undefined>> run() {
        std::vector<Undefined> found;
        if (watch_.calls.empty())
            return found;
        for (const Situation& situation : situations()) {
            const auto renderer = bench_.poised(situation);
            if (!renderer)
                return fail(renderer.error());
            const render::FrameInputs inputs = inputs_of(situation);
            (*renderer)->advance_to(pass_.pass, inputs);
            const Moment moment{**renderer, pass_.pass, inputs};
            if (!stand_in_) {
                auto linked = StandIn::link(moment, watch_.text, "the text with its domains watched");
                if (!linked)
                    return fail(std::move(linked.error()));
                stand_in_ = *std::move(linked);
            }
            look(moment, situation, found);
        }
        return found;
    }

private:
    void look(const Moment& moment, const Situation& situation, std::vector<Undefined>& found) {
        const std::vector<uint32_t> words = count(moment);
        const image::Image zero = with(moment, watch_.calls.size(), 0);
        for (size_t call = 0; call < watch_.calls.size(); ++call) {
            const uint32_t* of_call = &words[call * glsl::k_domain_words];
            const glsl::Node& node = pass_.text->tree()[watch_.calls[call]];
            const std::string place =
                place_of(*pass_.text, node.kind == glsl::NodeKind::call ? node.begin : node.word);
            if (of_call[0] == 0 || place.empty() || seen_.size() >= k_most_calls ||
                !seen_.insert(call).second)
                continue;
            image::Image worst;
            double share = -1;
            for (const double value : {std::numeric_limits<double>::quiet_NaN(), 1.0}) {
                image::Image other = with(moment, call, value);
                if (const double differs = differing(zero, other); differs > share) {
                    share = differs;
                    worst = image::difference_picture(zero, other, 1);
                }
            }
            const std::string_view name = glsl::domain_name(*pass_.text, watch_.calls[call]);
            const uint32_t pixel = ~of_call[1];
            const auto width = uint32_t(Situation().extent.width);
            found.push_back(
                {fmt::format("{} {} ({:.3g}, first at pixel {},{}) at {}", name, glsl::domain_fault(name),
                             std::bit_cast<float>(std::rotr(of_call[2], 1)), pixel % width, pixel / width,
                             place),
                 100 * share, situation, std::move(worst)});
            if (pass_.pass != bench_.scene().image_index())
                found.back().where.pass = bench_.scene().passes[pass_.pass].name;
        }
    }

    /// What each call met, as the scene stands.
    std::vector<uint32_t> count(const Moment& moment) {
        const ShaderWords words(watch_.calls.size() * glsl::k_domain_words);
        stand_in_->set(watch_.number_uniform, -1);
        stand_in_->draw(moment);
        return words.read();
    }

    /// What the pass shows where that call gives `value` outside of its domain, and all others 0.
    image::Image with(const Moment& moment, size_t call, double value) {
        const ShaderWords ignored(watch_.calls.size() * glsl::k_domain_words);
        stand_in_->set(watch_.number_uniform, double(call));
        stand_in_->set(watch_.value_uniform, value);
        stand_in_->draw(moment);
        return stand_in_->picture();
    }

    ProbeBench& bench_;
    const PassText& pass_;
    glsl::DomainWatch watch_;
    std::optional<StandIn> stand_in_;
    std::set<size_t> seen_;
};

} // namespace

Result<Answer> ask_undefined(ProbeBench& bench) {
    const auto texts = read_texts(bench, false);
    if (!texts)
        return Answer{Verdict::not_applicable, "not to be followed: " + to_string(texts.error())};
    std::vector<Undefined> all;
    for (const PassText& pass : *texts) {
        auto found = DomainProbe(bench, pass).run();
        if (!found)
            return Answer{Verdict::not_applicable, to_string(found.error())};
        std::ranges::move(*found, std::back_inserter(all));
    }
    std::ranges::stable_sort(all, std::greater(), &Undefined::percent);
    std::vector<std::string> told;
    for (const Undefined& each : all)
        if (each.percent > 0)
            told.push_back(fmt::format("{}: {:.3g} % of the pixels", each.sentence, each.percent));
    if (told.empty())
        return Answer{
            Verdict::pass,
            all.empty()
                ? "no function is called outside of its domain"
                : fmt::format("{} calls outside of a function's domain, none of which shows", all.size())};
    return Answer{Verdict::warn, "undefined, and in the picture: " + listed(told), all[0].where,
                  std::move(all[0].picture)};
}

} // namespace tidemark::lab
