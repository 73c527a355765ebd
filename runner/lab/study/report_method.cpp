#include "lab/study/report_method.hpp"

#include "lab/study/curves.hpp"
#include "lab/study/verdict.hpp"
#include "report/html.hpp"

#include <fmt/format.h>

namespace tidemark::lab {
namespace {

using report::escaped;

std::string list(const std::vector<std::string>& items) {
    std::string html = "<ul>\n";
    for (const std::string& item : items)
        html += fmt::format("<li>{}</li>\n", escaped(item));
    return html + "</ul>\n";
}

std::string standard(const char* name, const Standard& standard) {
    if (!standard.none.empty())
        return fmt::format("<dt>Reference of the {}</dt><dd>none: {}.</dd>\n", name, escaped(standard.none));
    return fmt::format("<dt>Reference of the {}</dt><dd>{}.<br>Its own error: {}; self-check: {}.{}</dd>\n",
                       name, escaped(standard.method),
                       standard.uncertainty ? figure(*standard.uncertainty) : std::string("unknown"),
                       escaped(standard.check),
                       standard.blind > 0 ? fmt::format("<br>It is NaN or infinite in {} pixels, of which no "
                                                        "error is told.",
                                                        standard.blind)
                                          : std::string());
}

std::string held(const WorkPrecisionSet& set) {
    std::string items;
    for (const Setting& setting : set.held)
        items += fmt::format("{}{} = {}", items.empty() ? "" : ", ", setting.name, setting.value);
    if (items.empty())
        return {};
    return fmt::format("<dt>Held fixed</dt><dd>{}. The truth has the same, so that no figure tells what they "
                       "cost.</dd>\n",
                       escaped(items));
}

} // namespace

std::string orders(const WorkPrecisionSet& set) {
    std::vector<std::string> items;
    for (const ObservedOrder& order : set.orders) {
        std::string fixed;
        for (const Setting& setting : order.fixed)
            fixed += fmt::format("{}{} = {}", fixed.empty() ? ", at " : ", ", setting.name, setting.value);
        items.push_back(to_string(order) + fixed);
    }
    if (items.empty())
        return {};
    return "<h2>How fast the error falls</h2>\n<p>The power of the knob by which it falls, over points that "
           "are not hollow.</p>\n" +
           list(items);
}

std::string method(const WorkPrecisionSet& set) {
    const Circumstances& facts = set.circumstances;
    std::string html = "<h2>How it was measured</h2>\n<dl class=\"facts\">\n";
    if (set.has_hits())
        html += standard("hits", set.hit_standard);
    if (set.has_pictures())
        html += standard("pictures", set.picture_standard);
    html += held(set);
    html += fmt::format(
        "<dt>Time</dt><dd>{}; {} warm-up rounds, then {} rounds; in each every setting has its turn with "
        "every view "
        "once, in an order shuffled anew (fixed seed); a setting that would take more than its share of the "
        "time sits "
        "rounds out. Medians with 95 % bootstrap intervals; compiling "
        "and the first draw apart. &ldquo;All&rdquo; is the mean over the views of each round.</dd>\n",
        escaped(facts.clock), facts.warm_up_rounds, facts.timed_rounds);
    html += fmt::format("<dt>Machine</dt><dd>{}{} cores; load {:.2f} before, {:.2f} after the timing.</dd>\n",
                        facts.renderer.empty()
                            ? std::string()
                            : fmt::format("{}, OpenGL {}; ", escaped(facts.renderer), escaped(facts.driver)),
                        facts.cores, facts.load_before, facts.load_after);
    if (set.has_pictures())
        html +=
            fmt::format("<dt>Scene</dt><dd>{} (SHA-256 of its text {}), {}x{} pixels, float target{}.</dd>\n",
                        escaped(facts.scene), facts.scene_sha256.substr(0, 16), set.study.extent.width,
                        set.study.extent.height,
                        set.study.precision == glsl::Precision::single ? "" : ", drawn in double");
    html += fmt::format("<dt>Program</dt><dd>tidemark {}, started {}.</dd>\n</dl>\n", facts.tidemark,
                        facts.started);
    return html;
}

std::string left_out(const WorkPrecisionSet& set) {
    std::vector<std::string> items = set.study.omissions;
    items.insert(items.end(), set.circumstances.remarks.begin(), set.circumstances.remarks.end());
    return items.empty() ? std::string() : "<h2>Left out</h2>\n" + list(items);
}

} // namespace tidemark::lab
