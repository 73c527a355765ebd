#include "base/error.hpp"
#include "lab/exploration.hpp"
#include "lab/instrumented_pass.hpp"
#include "lab/probes.hpp"
#include "lab/text_findings.hpp"
#include "media/comparison.hpp"
#include "media/image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

namespace tidemark::lab {

Result<WatchedDomains> WatchedDomains::link(const PassPreview& preview, const PassText& pass, Extent part) {
    constexpr std::string_view k_what = "the text that reports its domains";
    for (const auto scope : {glsl::DomainScope::everything, glsl::DomainScope::floats}) {
        glsl::DomainWatch watch = glsl::watch_domains(*pass.text, pass.facts, scope);
        auto linked = StandIn::link(preview, watch.text, k_what, part);
        if (linked)
            return WatchedDomains(std::move(watch), *std::move(linked));
        if (scope == glsl::DomainScope::floats)
            return fail(std::move(linked.error()));
    }
    return fail(ErrorCode::load, std::string(k_what));
}

void WatchedDomains::set(int site, double value, const PixelGrid& grid, size_t objectives) {
    stand_in_.set(watch_.number_uniform, site);
    stand_in_.set(watch_.value_uniform, value);
    stand_in_.set(watch_.stride_uniform, grid.stride);
    stand_in_.set(watch_.left_uniform, grid.left);
    stand_in_.set(watch_.down_uniform, grid.down);
    stand_in_.set(watch_.count_uniform, double(objectives));
    stand_in_.set(watch_.width_uniform, stand_in_.target().extent().width);
}

std::vector<uint32_t> WatchedDomains::draw(const PassPreview& preview, const PixelGrid& grid) {
    const ShaderWords words(std::max<size_t>(watch_.words(), 1));
    set(-1, 0, grid, watch_.objectives.size());
    stand_in_.draw(preview);
    return words.read();
}

image::Image WatchedDomains::picture_with(const PassPreview& preview, const PixelGrid& grid, size_t site,
                                          double value) {
    const ShaderWords ignored(std::max<size_t>(watch_.words(), 1));
    set(int(site), value, grid, 0);
    stand_in_.draw(preview);
    return stand_in_.picture();
}

bool WatchedDomains::finite() const {
    return !image::census(stand_in_.picture()).first_non_finite;
}

glm::ivec2 WatchedDomains::pixel(const PixelGrid& grid, uint32_t number) const {
    const int width = stand_in_.target().extent().width;
    return {grid.left + grid.stride * (int(number) % width), grid.down + grid.stride * (int(number) / width)};
}

namespace {

/// Returns the share of pixels that differ visibly: a GPU may give 0 where others give NaN or another number.
double differing(const image::Image& left, const image::Image& right) {
    return image::compare(left, right, 1.0 / 255)->differing_share();
}

/// Most calls per pass whose effect is measured; each needs two pictures.
constexpr size_t k_most_calls = 16;
/// Situations that the search adds to the ordinary ones.
constexpr size_t k_most_explored = 6;

class DomainProbe {
public:
    DomainProbe(ProbeBench& bench, const PassText& pass) : bench_(bench), pass_(pass) {}

    Result<std::vector<UndefinedCall>> run(const std::vector<PictureView>& views) {
        std::vector<UndefinedCall> found;
        for (const PictureView& view : views) {
            const auto preview = TRY(bench_.preview(view.state, pass_.pass));
            if (!watched_) {
                watched_ = TRY(WatchedDomains::link(preview, pass_, k_probe_extent));
            }
            look(preview, view, found);
        }
        return found;
    }

private:
    void look(const PassPreview& preview, const PictureView& view, std::vector<UndefinedCall>& found) {
        const glsl::DomainWatch& watch = watched_->watch();
        const std::vector<uint32_t> words = watched_->draw(preview, view.grid);
        std::optional<image::Image> zero;
        for (size_t i = 0; i < watch.sites.size(); ++i) {
            const glsl::DomainReading reading = reading_of(watch, words, i);
            const std::string place = place_of_site(*pass_.text, watch.sites[i]);
            if (reading.count == 0 || is_bound(watch.sites[i], reading) || place.empty() ||
                seen_.size() >= k_most_calls || !seen_.insert(i).second)
                continue;
            const glm::ivec2 pixel = watched_->pixel(view.grid, reading.pixel);
            const std::string what = domain_sentence(*pass_.text, watch.sites[i], reading);
            const std::string size =
                view.state.extent == k_probe_extent ? "" : " of " + scene::to_string(view.state.extent);
            UndefinedCall& each = found.emplace_back(UndefinedCall{
                fmt::format("{}, first at pixel {},{}{}) at {}", what, pixel.x, pixel.y, size, place),
                what.substr(0, what.rfind(" (")), location_of_site(*pass_.text, watch.sites[i]), pass_.pass,
                watch.sites[i], 0, view.state, image::Image()});
            if (pass_.pass != bench_.scene().image_index())
                each.where.pass = bench_.scene().passes[pass_.pass].name;
            if (!zero)
                zero = watched_->picture_with(preview, view.grid, watch.sites.size(), 0);
            for (const double value : {std::numeric_limits<double>::quiet_NaN(), 1.0}) {
                const image::Image other = watched_->picture_with(preview, view.grid, i, value);
                if (const double percent = 100 * differing(*zero, other);
                    each.picture.bytes.empty() || percent > each.percent) {
                    each.percent = percent;
                    each.picture = image::difference_picture(*zero, other, 1);
                }
            }
        }
    }

    ProbeBench& bench_;
    const PassText& pass_;
    std::optional<WatchedDomains> watched_;
    std::set<size_t> seen_;
};

} // namespace

Result<std::vector<PictureView>> usual_views(ProbeBench& bench) {
    const Extent size = k_probe_extent;
    std::vector<PictureView> all{
        {plain_state()},
        {state_at(0)},
        {with_mouse(render::Mouse::clicked({size.width / 3, size.height / 4}, false), state_at(10))},
        {plain_state({2 * size.width - 1, 2 * size.height + 1}), {1, size.width / 2, size.height / 2}}};
    const size_t ordinary = all.size();
    const auto explored = TRY(explore(bench));
    for (const Outside& outside : (explored)->outside) {
        if (outside.bound || all.size() >= ordinary + k_most_explored)
            continue;
        // Use as many pixels as in the ordinary views, at the same place.
        const Extent whole = outside.where.extent;
        const int stride = std::min(outside.grid.stride, whole.width / size.width);
        const auto first = [&](int at, int count, int of) {
            return std::clamp(at, 0, of - 1 - stride * (count - 1));
        };
        all.push_back({outside.where,
                       {stride, first(outside.grid.left, size.width, whole.width),
                        first(outside.grid.down, size.height, whole.height)}});
    }
    return all;
}

Result<std::vector<UndefinedCall>> find_undefined(ProbeBench& bench, const std::vector<PassText>& texts,
                                                  const std::vector<PictureView>& views) {
    std::vector<UndefinedCall> all;
    for (const PassText& pass : texts) {
        auto found = TRY(DomainProbe(bench, pass).run(views));
        std::ranges::move(found, std::back_inserter(all));
    }
    std::ranges::stable_sort(all, std::greater(), &UndefinedCall::percent);
    return all;
}

// Checks for what GLSL leaves undefined: functions outside their domain, whose values differ between GPUs,
// and indices, shifts, divisions, fetches and conversions out of bounds.

Result<Answer> ask_undefined(ProbeBench& bench) {
    const auto where = TRY(usual_views(bench));
    const auto texts = read_texts(bench, false);
    if (!texts)
        return Answer{Verdict::not_applicable, "the text cannot be analysed: " + to_string(texts.error())};
    auto found = find_undefined(bench, *texts, where);
    if (!found)
        return Answer{Verdict::not_applicable, to_string(found.error())};
    std::vector<UndefinedCall>& all = *found;
    std::vector<std::string> sentences;
    Answer answer{Verdict::warn};
    for (const UndefinedCall& each : all)
        if (each.percent > 0) {
            sentences.push_back(fmt::format("{}: {:.3g} % of the pixels", each.sentence, each.percent));
            add_place(answer, each.place);
        }
    if (sentences.empty())
        return Answer{
            Verdict::pass,
            all.empty()
                ? "no function is called outside of its domain"
                : fmt::format("{} calls outside of a function's domain, none of which changes a pixel",
                              all.size())};
    answer.sentence = "undefined, and visible in the picture: " + listed(sentences);
    answer.effect = "other GPUs may draw other pixels: " + all[0].what;
    answer.where = all[0].where;
    answer.picture = std::move(all[0].picture);
    return answer;
}

Result<Answer> ask_bounds(ProbeBench& bench) {
    const auto explored = TRY(explore(bench));
    if (!(explored)->left_out.empty())
        return Answer{Verdict::not_applicable, "the text cannot be analysed: " + (explored)->left_out};
    std::vector<std::string> sentences;
    Answer answer{Verdict::note};
    for (const Outside& outside : (explored)->outside)
        if (outside.bound) {
            sentences.push_back(outside.sentence);
            const Verdict level = outside.is_texel() ? Verdict::note : Verdict::warn;
            if (level > answer.verdict || !answer.where) {
                answer.effect = (outside.is_texel() ? "other hosts may draw garbage: "
                                                    : "other GPUs may draw garbage: ") +
                                outside.what;
                answer.where = outside.where;
                answer.places.clear();
            }
            answer.verdict = std::max(answer.verdict, level);
            if (level == answer.verdict)
                add_place(answer, outside.place);
        }
    if (sentences.empty())
        return Answer{Verdict::pass, "no index, shift, divisor, texel or conversion is out of bounds; " +
                                         (explored)->sentence};
    answer.sentence = listed(sentences);
    return answer;
}

} // namespace tidemark::lab
