#include "cli/check/fix_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tidemark::cli {
namespace {

Json number(const std::optional<double>& value) {
    return value ? Json(*value) : Json();
}

std::string both(const char* what, const std::optional<double>& before, const std::optional<double>& after,
                 const char* unit) {
    return before && after ? fmt::format("  {}: {:.3g} -> {:.3g}{}\n", what, *before, *after, unit) : "";
}

} // namespace

std::string to_text(const lab::Offer& offer, const glsl::Cure& cure) {
    const lab::Judgement& seen = offer.judgement;
    std::string text = fmt::format("{}\n  cure: {}\n  {}: {:.3g} -> {:.3g}\n", offer.finding, cure.reason,
                                   seen.fault.of, seen.fault.before, seen.fault.after);
    text += seen.changed == 0
                ? fmt::format("  elsewhere: the same bytes in {} pixels\n", seen.compared)
                : fmt::format("  elsewhere: other bytes in {} of {} pixels, FLIP {:.2g} at most\n",
                              seen.changed, seen.compared, seen.flip);
    text += both("error against double (RMSE)", seen.error_before, seen.error_after, "");
    return text + both("CPU of a frame of 320x180", seen.milliseconds_before, seen.milliseconds_after, " ms");
}

Json to_json(const lab::Offer& offer, const glsl::Cure& cure) {
    const lab::Judgement& seen = offer.judgement;
    return {{"finding", offer.finding},
            {"cure", cure.reason},
            {"fault", {{"of", seen.fault.of}, {"before", seen.fault.before}, {"after", seen.fault.after}}},
            {"pixels_compared", seen.compared},
            {"pixels_changed", seen.changed},
            {"flip", seen.flip},
            {"error_before", number(seen.error_before)},
            {"error_after", number(seen.error_after)},
            {"ms_before", number(seen.milliseconds_before)},
            {"ms_after", number(seen.milliseconds_after)}};
}

} // namespace tidemark::cli
