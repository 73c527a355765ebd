// What GLSL leaves undefined: functions outside of their domain, whose value is another thing on every GPU,
// and indices, shifts, divisions, fetches and conversions beyond their bounds.
#include "base/try.hpp"
#include "image/compare/difference.hpp"
#include "image/compare/metrics.hpp"
#include "lab/check/domain_fault.hpp"
#include "lab/check/exploration.hpp"
#include "lab/check/probes.hpp"
#include "lab/check/watched_domains.hpp"

#include <fmt/format.h>

#include <algorithm>
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
/// Situations that a search adds to those of everyday.
constexpr size_t k_most_explored = 6;

/// A moment, and the pixels that are drawn of it.
struct View {
    FrameState state;
    PixelGrid grid{};
};

/// Everyday, and those in which a search saw values leave their domain.
Result<std::vector<View>> views(ProbeBench& bench) {
    const Extent size = k_probe_extent;
    std::vector<View> all{
        {plain_state()},
        {state_at(0)},
        {with_mouse(render::Mouse::clicked({size.width / 3, size.height / 4}, false), state_at(10))}};
    const auto explored = TRY(explore(bench));
    for (const Outside& outside : (explored)->outside) {
        if (outside.bound || all.size() >= 3 + k_most_explored)
            continue;
        // As many pixels as those of everyday, in the same place.
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

/// A site that was undefined, with what depends on it.
struct Undefined {
    std::string sentence;
    double percent = 0; ///< of the pixels
    FrameState where;
    image::Image picture;
};

class DomainProbe {
public:
    DomainProbe(ProbeBench& bench, const PassText& pass) : bench_(bench), pass_(pass) {}

    Result<std::vector<Undefined>> run(const std::vector<View>& views) {
        std::vector<Undefined> found;
        for (const View& view : views) {
            const auto preview = TRY(bench_.preview(view.state, pass_.pass));
            if (!watched_) {
                watched_ = TRY(WatchedDomains::link(preview, pass_, k_probe_extent));
            }
            look(preview, view, found);
        }
        return found;
    }

private:
    void look(const PassPreview& preview, const View& view, std::vector<Undefined>& found) {
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
            Undefined& each = found.emplace_back(Undefined{
                fmt::format("{}, first at pixel {},{}) at {}",
                            domain_sentence(*pass_.text, watch.sites[i], reading), pixel.x, pixel.y, place),
                0, view.state, image::Image()});
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

Result<Answer> ask_undefined(ProbeBench& bench) {
    const auto where = TRY(views(bench));
    const auto texts = read_texts(bench, false);
    if (!texts)
        return Answer{Verdict::not_applicable, "the text cannot be followed: " + to_string(texts.error())};
    std::vector<Undefined> all;
    for (const PassText& pass : *texts) {
        auto found = DomainProbe(bench, pass).run(where);
        if (!found)
            return Answer{Verdict::not_applicable, to_string(found.error())};
        std::ranges::move(*found, std::back_inserter(all));
    }
    std::ranges::stable_sort(all, std::greater(), &Undefined::percent);
    std::vector<std::string> sentences;
    for (const Undefined& each : all)
        if (each.percent > 0)
            sentences.push_back(fmt::format("{}: {:.3g} % of the pixels", each.sentence, each.percent));
    if (sentences.empty())
        return Answer{
            Verdict::pass,
            all.empty()
                ? "no function is called outside of its domain"
                : fmt::format("{} calls outside of a function's domain, none of which changes a pixel",
                              all.size())};
    return Answer{Verdict::warn, "undefined, and visible in the picture: " + listed(sentences), all[0].where,
                  std::move(all[0].picture)};
}

Result<Answer> ask_bounds(ProbeBench& bench) {
    const auto explored = TRY(explore(bench));
    if (!(explored)->left_out.empty())
        return Answer{Verdict::not_applicable, "the text cannot be followed: " + (explored)->left_out};
    std::vector<std::string> sentences;
    std::optional<FrameState> where;
    for (const Outside& outside : (explored)->outside)
        if (outside.bound) {
            sentences.push_back(outside.sentence);
            where = where ? where : outside.where;
        }
    if (sentences.empty())
        return Answer{Verdict::pass, "no index, shift, divisor, texel or conversion is out of bounds; " +
                                         (explored)->sentence};
    return Answer{Verdict::warn, listed(sentences), where};
}

} // namespace tidemark::lab
