#include "glsl/cure/whole_counter.hpp"

#include <fmt/format.h>

namespace tidemark::glsl {

std::optional<Cure> whole_counter(const ParsedText& text, const FloatCounter& counter) {
    const SyntaxTree& tree = text.tree();
    const NodeId head = tree.child(counter.loop, 0), step = tree.child(counter.loop, 2),
                 body = tree.child(counter.loop, 3);
    const auto from = written_for(text, head, head), to = written_for(text, step, step),
               inside = written_for(text, body, body);
    if (!from || !to || !inside)
        return std::nullopt;
    const std::string turn = fresh_name(text, fmt::format("{}_turn", counter.name));
    Cure cure;
    cure.wraps.push_back(
        in_place_of(text, {from->first, to->last},
                    fmt::format("int {0} = 0; {0} < {1}; ++{0}", turn, counter.exact_turns)));
    cure.wraps.push_back(
        wrapped(text, *inside,
                fmt::format("{{ float {} = {} {} {} * float({}); ", counter.name, text.excerpt(counter.first),
                            counter.down ? "-" : "+", text.excerpt(counter.step), turn),
                " }"));
    cure.reason = fmt::format("counts in whole numbers: {} turns, as the numbers of the text have it",
                              counter.exact_turns);
    return cure;
}

} // namespace tidemark::glsl
