#include "lab/check/domain_fault.hpp"

#include "lab/check/probe_text.hpp"
#include "lab/trace/nan_origin.hpp"
#include "lab/trace/operation.hpp"

#include <fmt/format.h>

#include <bit>

namespace tidemark::lab {

using glsl::DomainKind;
using glsl::DomainReading;

bool is_bound(const glsl::DomainSite& site, const DomainReading& reading) {
    switch (site.kind) {
    case DomainKind::function: return false;
    case DomainKind::quotient: return reading.limit != 0; // 1: of whole numbers, 0: of floats
    default: return true;
    }
}

std::string domain_sentence(const glsl::ParsedText& text, const glsl::DomainSite& site,
                            const DomainReading& reading) {
    const std::string_view name = glsl::domain_name(text, site.node);
    const auto whole = int32_t(reading.argument);
    const auto number = std::bit_cast<float>(reading.argument);
    const std::string excerpt = fmt::format("`{}`", shortened(text.excerpt(site.node)));
    switch (site.kind) {
    case DomainKind::quotient:
        if (reading.limit == 0)
            break;
        [[fallthrough]];
    case DomainKind::divisor: return fmt::format("{}: a whole number divided by 0", excerpt);
    case DomainKind::shift: return fmt::format("{}: a shift by {}, outside of 0 to 31", excerpt, whole);
    case DomainKind::index:
        return fmt::format("{}: index {} outside of 0 to {}", excerpt, whole, reading.limit);
    case DomainKind::fetch:
        return reading.limit >= 0x10000000u
                   ? fmt::format("{}: level {}", excerpt, whole)
                   : fmt::format("{}: texel {} outside of 0 to {}, which is 0 on the site and here", excerpt,
                                 whole, reading.limit);
    case DomainKind::conversion:
        return fmt::format("{} is {}, outside of the range of {}", excerpt, to_shortest(number),
                           site.to_unsigned ? "uint" : "int");
    default: break;
    }
    return fmt::format("{} {} ({}", name, glsl::domain_fault(name, number), to_shortest(number));
}

std::string place_of_site(const glsl::ParsedText& text, const glsl::DomainSite& site) {
    const glsl::Node& node = text.tree()[site.node];
    const bool has_sign = node.kind == glsl::NodeKind::binary || node.kind == glsl::NodeKind::assign;
    return place_of(text, has_sign ? node.word : node.begin);
}

} // namespace tidemark::lab
