#include "lab/check/undefined_calls.hpp"

#include "base/try.hpp"
#include "image/compare/difference.hpp"
#include "image/compare/metrics.hpp"
#include "lab/check/domain_fault.hpp"
#include "lab/check/exploration.hpp"
#include "lab/check/watched_domains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>

namespace tidemark::lab {
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
            UndefinedCall& each = found.emplace_back(UndefinedCall{
                fmt::format("{}, first at pixel {},{}) at {}",
                            domain_sentence(*pass_.text, watch.sites[i], reading), pixel.x, pixel.y, place),
                pass_.pass, watch.sites[i].node, 0, view.state, image::Image()});
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
        {with_mouse(render::Mouse::clicked({size.width / 3, size.height / 4}, false), state_at(10))}};
    const auto explored = TRY(explore(bench));
    for (const Outside& outside : (explored)->outside) {
        if (outside.bound || all.size() >= 3 + k_most_explored)
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

} // namespace tidemark::lab
