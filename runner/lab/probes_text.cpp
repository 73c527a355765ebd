// What the text alone tells.
#include "glsl/unassigned.hpp"
#include "lab/probe_text.hpp"
#include "lab/probes.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tidemark::lab {

Result<Answer> ask_unassigned(ProbeBench& bench) {
    const auto texts = read_texts(bench, true);
    if (!texts)
        return Answer{Verdict::not_applicable, "not to be followed: " + to_string(texts.error())};
    std::vector<std::string> found;
    for (const PassText& pass : *texts)
        for (const glsl::Unassigned& each : glsl::find_unassigned(*pass.text, pass.facts)) {
            const bool unread = each.read == glsl::k_no_node;
            const size_t word = pass.text->tree()[unread ? each.variable : each.read].word;
            const std::string place = place_of(*pass.text, word);
            const std::string said = fmt::format("{} ({}{})", pass.text->word_of(each.variable), place,
                                                 unread ? ", an `out` that is never written" : "");
            if (!place.empty() && std::ranges::find(found, said) == found.end())
                found.push_back(said);
        }
    if (found.empty())
        return Answer{Verdict::pass, "nothing is read before it has a value"};
    return Answer{Verdict::warn,
                  "read before it has a value, which is 0 on ShaderToy's site and here, and anything "
                  "elsewhere: " +
                      listed(found)};
}

} // namespace tidemark::lab
