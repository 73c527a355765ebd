// Cures and cuts that are proposed for any text: each is put into it, or says that it cannot be, and what
// comes of it is a text that is read again.
#include "fuzz.hpp"
#include "shader/cuts.hpp"
#include "shader/fixes.hpp"
#include "shader/undefined_behaviour.hpp"

#include <iterator>
#include <vector>

using namespace tidemark;

namespace {

constexpr size_t k_most_cures = 50; ///< that are tried

Result<std::unique_ptr<const glsl::ParsedText>> read(std::string_view text) {
    text::MappedText source;
    source.append(text, "a.glsl", 1);
    return glsl::ParsedText::read(std::move(source), {});
}

std::vector<glsl::Cure> proposed(const glsl::ParsedText& text) {
    const glsl::TreeFacts facts = glsl::find_facts(text);
    std::vector<glsl::Cure> cures;
    for (const auto propose : {glsl::reduced_times, glsl::rewrites, glsl::whole_hashes})
        std::ranges::move(propose(text, facts), std::back_inserter(cures));
    for (const glsl::FloatCounter& each : glsl::miscounting_loops(text, facts))
        if (auto cure = glsl::whole_counter(text, each))
            cures.push_back(*std::move(cure));
    for (const glsl::Unassigned& each : glsl::find_unassigned(text, facts))
        if (auto cure = glsl::initial_value(text, facts, each))
            cures.push_back(*std::move(cure));
    for (const glsl::Divergent& each :
         glsl::find_divergent(text, facts, [](std::string_view) { return true; }))
        for (const auto propose : {glsl::hoisted_derivative, glsl::base_level})
            if (auto cure = propose(text, facts, each))
                cures.push_back(*std::move(cure));
    for (const glsl::DomainSite& each : glsl::find_domain_sites(text, facts, glsl::DomainScope::floats))
        std::ranges::move(glsl::domain_guards(text, facts, each.node), std::back_inserter(cures));
    const glsl::Cutter cutter(text, facts);
    for (auto& cuts : {cutter.cuts(), cutter.levels([](std::string_view) { return true; })})
        for (const glsl::Cut& each : cuts)
            cures.push_back(each.change);
    if (auto cut = glsl::once_a_pixel(text, facts, cutter.work()))
        cures.push_back(std::move(cut->change));
    return cures;
}

} // namespace

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view text = text_of(data, size);
    const auto parsed = read(text);
    if (!parsed)
        return 0;
    std::vector<glsl::Cure> cures = proposed(**parsed);
    cures.resize(std::min(cures.size(), k_most_cures));
    for (const glsl::Cure& cure : cures) {
        REQUIRE(!cure.wraps.empty());
        REQUIRE(!cure.reason.empty());
        if (const auto changed = glsl::cured(text, "a.glsl", std::span(&cure, 1)))
            REQUIRE(read(*changed).has_value());
    }
    return 0;
}
