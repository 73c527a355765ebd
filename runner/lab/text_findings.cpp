#include "lab/text_findings.hpp"

#include "base/error.hpp"
#include "base/tokens.hpp"
#include "lab/instrumented_pass.hpp"
#include "lab/nan_trace.hpp"
#include "lab/probed_pictures.hpp"
#include "lab/probes.hpp"
#include "lab/scene_numbers.hpp"
#include "media/comparison.hpp"
#include "scene/host_uniforms.hpp"
#include "shader/fixes.hpp"
#include "shader/undefined_behaviour.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace tidemark::lab {
namespace {

/// A seam is one or two pixels wide: large enough a picture that mipmaps are read as in an ordinary one.
constexpr Extent k_seam_extent{320, 180};
/// Percent of the pixels: fewer are a dot, not a line.
constexpr double k_least_of_a_seam = 0.1;
/// Percent of the pixels: where more change, the coordinates jump everywhere, and there is no line to see.
constexpr double k_most_of_a_seam = 20;

} // namespace

Result<std::vector<PassText>> read_texts(ProbeBench& bench, bool as_written) {
    const auto renderer = TRY(bench.compiled());
    std::vector<PassText> texts;
    for (const render::PlannedPass& planned : (renderer)->plan().passes) {
        if (bench.scene().passes[planned.pass].kind == scene::PassKind::cubemap)
            continue;
        auto text = TRY(read_text(*renderer, planned.pass, as_written));
        glsl::TreeFacts facts = glsl::find_facts(*text);
        texts.push_back({planned.pass, std::move(text), std::move(facts)});
    }
    return texts;
}

std::string place_of(const glsl::ParsedText& text, size_t word) {
    const SourceLocation where = text.spelled(word);
    return where.file.empty() ? std::string() : fmt::format("{}:{}", where.file, where.line);
}

std::string listed(const std::vector<std::string>& names) {
    constexpr size_t k_most = 4;
    std::string text;
    for (size_t i = 0; i < names.size() && i < k_most; ++i)
        text += fmt::format("{}{}", i > 0 ? ", " : "", names[i]);
    if (names.size() > k_most)
        text += fmt::format(" and {} more", names.size() - k_most);
    return text;
}

std::string_view words_for(glsl::Unassigned::Why why) {
    using Why = glsl::Unassigned::Why;
    return why == Why::never              ? ""
           : why == Why::on_some_way      ? ", on some path"
           : why == Why::not_given        ? ", an `out` that is never written"
           : why == Why::left_on_some_way ? ", an `out` that some path does not write"
                                          : ", on some path without a `return`";
}

size_t word_without_value(const glsl::ParsedText& text, const glsl::Unassigned& each) {
    using Why = glsl::Unassigned::Why;
    const bool declared = each.why == Why::not_given || each.why == Why::left_on_some_way;
    return text.tree()[declared ? each.what : each.at].word;
}

std::string sentence_for(const glsl::ParsedText& text, const glsl::Unassigned& each) {
    const std::string place = place_of(text, word_without_value(text, each));
    if (place.empty())
        return {};
    return fmt::format("{} ({}{})", text.word_of(each.what), place, words_for(each.why));
}

std::string sentence_for(const glsl::ParsedText& text, const glsl::WrongEdges& each) {
    const std::string place = place_of(text, text.tree()[each.call].begin);
    if (place.empty())
        return {};
    return fmt::format("`{}` ({}, {})", shortened(text.excerpt(each.call)), place,
                       each.equal ? "its edges are equal" : "its low edge is above its high one");
}

std::string words_for(const glsl::ParsedText& text, const glsl::DivergentBranch& branch) {
    const glsl::Node& at = text.tree()[branch.at];
    const std::string place = place_of(text, at.begin);
    const std::string_view called = branch.called ? "called " : "";
    if (!branch.exit)
        return fmt::format("{}{} {}", called,
                           branch.called ? "where neighbours may branch at" : "neighbours may branch at",
                           place);
    const bool by_call = at.kind == glsl::NodeKind::call;
    return fmt::format("{}after the {} at {}", called, by_call ? "discard in a call" : text.word(at.word),
                       place);
}

std::string words_for(const glsl::ParsedText& text, const glsl::Divergent& each) {
    return fmt::format("{} needs neighbouring pixels, which may have taken another branch: {}",
                       glsl::called_name(text, each.call), words_for(text, each.branch));
}

std::string words_for(const glsl::FloatCounter& counter) {
    if (std::isinf(counter.turns))
        return fmt::format("the loop never ends: {} stops changing once a step is less than its rounding",
                           counter.name);
    return fmt::format("{} counts {} iterations instead of {}: each step is rounded", counter.name,
                       counter.turns, counter.exact_turns);
}

std::function<bool(std::string_view)> which_have_mipmaps(const scene::Pass& pass) {
    return [&channels = pass.channels](std::string_view sampler) {
        const auto name = std::ranges::find(scene::k_channel_names, sampler);
        return name != scene::k_channel_names.end() &&
               channels[size_t(name - scene::k_channel_names.begin())].sampling.mipmaps !=
                   scene::Mipmaps::none;
    };
}

using glsl::DomainKind;
using glsl::DomainReading;

bool is_bound(const glsl::DomainSite& site, const DomainReading& reading) {
    switch (site.kind) {
    case DomainKind::function:
    case DomainKind::whole: return false;
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
    case DomainKind::divisor: return fmt::format("{}: an integer divided by 0", excerpt);
    case DomainKind::negative:
        return text.word_of(site.node).starts_with('%')
                   ? fmt::format("{}: the remainder of a negative integer ({}), which is undefined", excerpt,
                                 whole)
                   : fmt::format("{}: a negative integer ({}) divided with a remainder, whose rounding is "
                                 "undefined",
                                 excerpt, whole);
    case DomainKind::whole:
        if (number == 0)
            break;
        return fmt::format("{}: a whole quotient that GPUs with reciprocals miss ({}", excerpt,
                           to_shortest(number));
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

namespace {

size_t word_of_site(const glsl::ParsedText& text, const glsl::DomainSite& site) {
    const glsl::Node& node = text.tree()[site.node];
    const bool has_sign = node.kind == glsl::NodeKind::binary || node.kind == glsl::NodeKind::assign;
    return has_sign ? node.word : node.begin;
}

} // namespace

std::string place_of_site(const glsl::ParsedText& text, const glsl::DomainSite& site) {
    return place_of(text, word_of_site(text, site));
}

SourceLocation location_of_site(const glsl::ParsedText& text, const glsl::DomainSite& site) {
    return text.spelled(word_of_site(text, site));
}

// Probes that only read the text.

namespace {

/// Returns whether the variable is only ever set by updates, as in `sum += x`: then the first one reads no
/// value.
bool is_set_by_updates_only(const glsl::ParsedText& text, const glsl::Unassigned& each) {
    constexpr std::string_view k_updates[] = {"+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "++", "--"};
    if (each.why != glsl::Unassigned::Why::on_some_way)
        return false;
    const std::string_view name = text.word_of(each.what);
    const glsl::SyntaxTree& tree = text.tree();
    const glsl::NodeId scope = tree.around(each.what, glsl::NodeKind::block);
    if (scope == glsl::k_no_node)
        return false;
    bool updated = false;
    for (size_t i = tree[each.what].begin; i + 1 < tree[scope].end; ++i)
        if (text.word(i) == name) {
            if (text.word(i + 1) == "=")
                return false;
            updated |= std::ranges::find(k_updates, text.word(i + 1)) != std::end(k_updates);
        }
    return updated;
}

/// Returns the change that gives a variable ones instead of zeros at its beginning.
glsl::Cure with_ones(glsl::Cure zeros) {
    for (glsl::Wrap& wrap : zeros.wraps)
        for (std::string* const part : {&wrap.front, &wrap.behind}) {
            std::string ones;
            size_t copied = 0;
            for (const text::Token& token : text::tokenize(*part)) {
                ones.append(*part, copied, token.begin - copied);
                ones += token.is("0.0")     ? "1.0"
                        : token.is("0")     ? "1"
                        : token.is("false") ? "true"
                                            : token.text;
                copied = token.end();
            }
            *part = ones.append(*part, copied, std::string::npos);
        }
    return zeros;
}

/// A variable that only some path leaves without a value.
struct Doubtful {
    std::string said;
    SourceLocation where;
    std::optional<glsl::Cure> zero; ///< sets it to 0 where it begins
};

/// Returns whether the picture depends on the values that these variables have before they are set: then the
/// path that leaves them is taken.
bool shows_unset(ProbeBench& bench, const std::vector<glsl::Cure>& zeros) {
    std::vector<glsl::Cure> ones;
    for (const glsl::Cure& each : zeros)
        ones.push_back(with_ones(each));
    const auto with_zeros = changed(bench.scene(), zeros), other = changed(bench.scene(), ones);
    if (!with_zeros || !other)
        return false;
    ProbeBench left(*with_zeros, bench.promises()), right(*other, bench.promises());
    for (const double moment : {0.5, 3.0, 11.0}) {
        const auto before = left.picture(state_at(moment)), after = right.picture(state_at(moment));
        if (!before || !after)
            return false;
        if (before->bytes != after->bytes)
            return true;
    }
    return false;
}

/// Returns whether the picture shows one of the variables unset, and moves the first one that it shows to the
/// front.
bool move_shown_first(ProbeBench& bench, std::vector<Doubtful>& doubtful) {
    constexpr size_t k_most_alone = 4;
    std::vector<glsl::Cure> zeros;
    std::vector<size_t> with_zero;
    for (size_t i = 0; i < doubtful.size(); ++i)
        if (doubtful[i].zero) {
            zeros.push_back(*doubtful[i].zero);
            with_zero.push_back(i);
        }
    if (zeros.empty() || !shows_unset(bench, zeros))
        return false;
    for (size_t i = 0; i < std::min(zeros.size(), k_most_alone); ++i)
        if (zeros.size() == 1 || shows_unset(bench, {zeros[i]})) {
            std::rotate(doubtful.begin(), doubtful.begin() + ptrdiff_t(with_zero[i]),
                        doubtful.begin() + ptrdiff_t(with_zero[i] + 1));
            break;
        }
    return true;
}

} // namespace

Result<Answer> ask_unassigned(ProbeBench& bench) {
    const auto texts = read_texts(bench, true);
    if (!texts)
        return Answer{Verdict::not_applicable, "the text cannot be analysed: " + to_string(texts.error())};
    std::vector<std::string> found;
    std::vector<Doubtful> doubtful;
    Answer answer{Verdict::note};
    for (const PassText& pass : *texts)
        for (const glsl::Unassigned& each : glsl::find_unassigned(*pass.text, pass.facts)) {
            std::string said = sentence_for(*pass.text, each);
            if (said.empty() || std::ranges::find(found, said) != found.end())
                continue;
            const SourceLocation where = pass.text->spelled(word_without_value(*pass.text, each));
            if (each.why == glsl::Unassigned::Why::never || each.why == glsl::Unassigned::Why::not_given ||
                is_set_by_updates_only(*pass.text, each)) {
                answer.verdict = Verdict::warn;
                add_place(answer, where);
                found.insert(found.begin(), std::move(said));
                continue;
            }
            found.push_back(said); // the path to it may never be taken
            doubtful.push_back({std::move(said), where, glsl::initial_value(*pass.text, pass.facts, each)});
        }
    const bool shows = move_shown_first(bench, doubtful);
    if (shows && answer.verdict == Verdict::note) {
        answer.verdict = Verdict::warn;
        std::erase(found, doubtful.front().said);
        found.insert(found.begin(), doubtful.front().said);
    }
    for (const Doubtful& each : doubtful)
        add_place(answer, each.where);
    const std::string_view looked =
        "all paths through the functions that run were checked, whatever the conditions";
    if (found.empty())
        return Answer{Verdict::pass, fmt::format("nothing is read without a value: {}", looked)};
    answer.sentence =
        fmt::format("read without a value (0 on ShaderToy's site and here, undefined elsewhere): {}{}; {}",
                    listed(found), shows ? "; the picture is another one if it is 1" : "", looked);
    answer.effect = fmt::format("some hosts {}draw garbage: {} {} read before it has a value",
                                answer.verdict == Verdict::warn ? "" : "may ",
                                found.front().substr(0, found.front().find(' ')),
                                answer.verdict == Verdict::warn ? "is" : "may be");
    return answer;
}

Result<Answer> ask_divergence(ProbeBench& bench) {
    const auto texts = read_texts(bench, true);
    if (!texts)
        return Answer{Verdict::not_applicable, "the text cannot be analysed: " + to_string(texts.error())};
    std::vector<std::string> found, harmless;
    Answer answer{Verdict::warn};
    std::vector<SourceLocation> harmless_places;
    for (const PassText& pass : *texts) {
        const glsl::ParsedText& text = *pass.text;
        for (const glsl::Divergent& each :
             glsl::find_divergent(text, pass.facts, which_have_mipmaps(bench.scene().passes[pass.pass]))) {
            const std::string place = place_of(text, text.tree()[each.call].begin);
            if (place.empty())
                continue;
            (each.harmless ? harmless : found)
                .push_back(fmt::format("{} ({}, {})", glsl::called_name(text, each.call), place,
                                       words_for(text, each.branch)));
            const SourceLocation where = text.spelled(text.tree()[each.call].begin);
            if (each.harmless)
                harmless_places.push_back(where);
            else
                add_place(answer, where);
        }
    }
    const std::string also =
        harmless.empty() ? ""
                         : "undefined in GLSL, though GPUs that we know draw it, as neighbouring pixels have "
                           "the same coordinates' values: " +
                               listed(harmless);
    if (found.empty() && harmless.empty())
        return Answer{Verdict::pass, "derivatives and mipmaps only in uniform control flow"};
    if (found.empty()) {
        answer.verdict = Verdict::note;
        answer.sentence = also;
        answer.effect = "a texture or derivative is read in a branch, of values from before it";
        for (const SourceLocation& where : harmless_places)
            add_place(answer, where);
        return answer;
    }
    answer.sentence = "needs neighbouring pixels, which may have taken another branch: " + listed(found) +
                      (also.empty() ? "" : "; " + also);
    return answer;
}

Result<Answer> ask_counters(ProbeBench& bench) {
    const auto texts = read_texts(bench, true);
    if (!texts)
        return Answer{Verdict::not_applicable, "the text cannot be analysed: " + to_string(texts.error())};
    std::vector<std::string> found;
    Answer answer{Verdict::warn};
    for (const PassText& pass : *texts)
        for (const glsl::FloatCounter& each : glsl::miscounting_loops(*pass.text, pass.facts)) {
            const std::string place = place_of(*pass.text, pass.text->tree()[each.loop].begin);
            std::string said = fmt::format("{}: {}", place, words_for(each));
            if (place.empty() || std::ranges::find(found, said) != found.end())
                continue;
            found.push_back(std::move(said));
            add_place(answer, pass.text->spelled(pass.text->tree()[each.loop].begin));
            if (answer.effect.empty() || std::isinf(each.turns))
                answer.effect = words_for(each);
            if (std::isinf(each.turns))
                answer.verdict = Verdict::fail;
        }
    if (found.empty())
        return Answer{Verdict::pass, "no float loop counter gains or loses an iteration through rounding"};
    answer.sentence = listed(found);
    return answer;
}

Result<Answer> ask_edges(ProbeBench& bench) {
    const auto texts = read_texts(bench, true);
    if (!texts)
        return Answer{Verdict::not_applicable, "the text cannot be analysed: " + to_string(texts.error())};
    std::vector<std::string> reversed, others;
    Answer answer{Verdict::warn};
    for (const PassText& pass : *texts)
        for (const glsl::WrongEdges& each : glsl::find_wrong_edges(*pass.text, pass.facts)) {
            const std::string said = sentence_for(*pass.text, each);
            const bool clamps = glsl::called_name(*pass.text, each.call) == "clamp";
            auto& list = clamps || each.equal ? others : reversed;
            if (said.empty() || std::ranges::find(list, said) != list.end())
                continue;
            list.push_back(said);
            if (clamps || each.equal)
                add_place(answer, pass.text->spelled(pass.text->tree()[each.call].begin));
        }
    const std::string known =
        reversed.empty()
            ? ""
            : fmt::format("undefined in GLSL, though GPUs that we know draw it: {}", listed(reversed));
    if (others.empty())
        return Answer{Verdict::pass,
                      known.empty() ? "no clamp or smoothstep has its edges in the wrong order" : known};
    answer.sentence = listed(others) + (known.empty() ? "" : "; " + known);
    return answer;
}

Result<std::vector<Seam>> find_seams(ProbeBench& bench, const std::vector<PassText>& texts) {
    std::vector<Seam> found;
    for (const PassText& pass : texts)
        for (const glsl::JumpingLookUp& each : glsl::find_jumping_look_ups(
                 *pass.text, pass.facts, which_have_mipmaps(bench.scene().passes[pass.pass]))) {
            const std::string place = place_of(*pass.text, pass.text->tree()[each.call].begin);
            auto cure = glsl::smooth_look_up(*pass.text, pass.facts, each);
            const auto scene = cure ? changed(bench.scene(), std::span(&*cure, 1)) : std::nullopt;
            if (place.empty() || !scene || std::ranges::find(found, place, &Seam::place) != found.end())
                continue;
            const FrameState state = plain_state(k_seam_extent);
            const image::Image before = TRY(bench.picture(state));
            const auto after = ProbeBench(*scene, bench.promises()).picture(state);
            const double percent = after ? visibly_different_percent(before, *after) : 0;
            if (percent >= k_least_of_a_seam && percent < k_most_of_a_seam)
                found.push_back(
                    {place, pass.text->spelled(pass.text->tree()[each.call].begin),
                     fmt::format("{}: the coordinates of `{}` jump by {}, so that pixels at the "
                                 "jump read a blurred mipmap: a line in {:.2g} % of the picture",
                                 place, shortened(pass.text->excerpt(each.call)), each.jump, percent),
                     state, image::difference_picture(before, *after, 1), *std::move(cure)});
        }
    return found;
}

Result<Answer> ask_seams(ProbeBench& bench) {
    const auto texts = read_texts(bench, true);
    if (!texts)
        return Answer{Verdict::not_applicable, "the text cannot be analysed: " + to_string(texts.error())};
    std::vector<Seam> found = TRY(find_seams(bench, *texts));
    if (found.empty())
        return Answer{Verdict::pass, "no mipmap is chosen across a jump of its coordinates"};
    std::vector<std::string> sentences;
    for (const Seam& seam : found)
        sentences.push_back(seam.sentence);
    Answer answer{Verdict::fail, listed(sentences), found[0].where, std::move(found[0].picture)};
    for (const Seam& seam : found)
        add_place(answer, seam.location);
    return answer;
}

} // namespace tidemark::lab
