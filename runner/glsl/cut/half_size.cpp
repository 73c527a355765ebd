#include "glsl/cut/half_size.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

namespace tidemark::glsl {
namespace {

/// Share of the buffer's pixels that are no longer drawn.
constexpr double k_saved = 0.75;

bool says(const ParsedText& text, std::string_view name) {
    for (size_t i = 0; i < text.words().size(); ++i)
        if (text.word(i) == name && !text.used(i).file.empty())
            return true;
    return false;
}

/// Returns the files that belong to more than one pass.
std::set<std::string> shared_files(std::span<const BufferReader> passes) {
    std::map<std::string, size_t> owners;
    std::set<std::string> shared;
    for (size_t pass = 0; pass < passes.size(); ++pass)
        for (size_t i = 0; i < passes[pass].text.words().size(); ++i) {
            const std::string file = passes[pass].text.used(i).file;
            if (!file.empty() && owners.try_emplace(file, pass).first->second != pass)
                shared.insert(file);
        }
    return shared;
}

/// Collects the edits that redirect one sampler's look-ups to the buffer's drawn quarter. A repeating sampler
/// would mix in the opposite edge, so its look-ups stay half a pixel away from the edge.
class LookUps {
public:
    LookUps(const BufferReader& reader, const BufferSampler& sampler)
        : text_(reader.text), tree_(text_.tree()), facts_(reader.facts), sampler_(sampler) {}

    /// Returns nothing if a look-up cannot be redirected.
    std::optional<std::vector<Wrap>> run() {
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
            const bool named = tree_[id].kind == NodeKind::name && text_.word_of(id) == sampler_.name &&
                               !text_.used(tree_[id].word).file.empty();
            if (named && !lead(id))
                return std::nullopt;
        }
        return std::move(wraps_);
    }

private:
    bool lead(NodeId sampler) {
        const NodeId call = tree_[sampler].parent;
        if (tree_[call].kind != NodeKind::call || tree_.child_count(call) < 3 ||
            tree_.child(call, 1) != sampler || facts_.function(called_name(text_, call)))
            return false;
        const auto said = written_for(text_, sampler, call);
        const auto place = written_for(text_, tree_.child(call, 2), call);
        // A macro that takes its sampler as an argument would redirect the look-ups of other samplers, too.
        if (!said || !place || text_.tokens()[said->first].text != sampler_.name)
            return false;
        const std::string_view name = called_name(text_, call);
        const size_t operands = tree_.child_count(call) - 1;
        if ((name == "texture" && operands == 2) || (name == "textureLod" && operands == 3))
            add(sampler_.repeats ? wrapped(text_, *place, "max(0.5 * fract(", "), 0.5 / iResolution.xy)")
                                 : wrapped(text_, *place, "0.5 * clamp(", ", 0.0, 1.0)"));
        else if (name == "texelFetch" && operands == 3)
            return lead_fetch(call, *place);
        else
            return false;
        return true;
    }

    /// Redirects a fetch of one pixel to a filtered look-up: the pixel's centre now lies between four drawn
    /// pixels.
    bool lead_fetch(NodeId call, WrittenTokens place) {
        const auto whole = written_for(text_, call, call);
        const auto level = written_for(text_, tree_.child(call, 3), call);
        if (!whole || !level || level->first != level->last || text_.tokens()[level->first].text != "0" ||
            text_.tokens()[whole->first].text != "texelFetch")
            return false;
        add(in_place_of(text_, {whole->first, whole->first}, "textureLod"));
        add(wrapped(text_, place, "max(0.5 * (vec2(", ") + 0.5), 0.5) / iResolution.xy"));
        add(in_place_of(text_, *level, "0.0"));
        return true;
    }

    /// Adds an edit once: a macro's body is written once, however often it is used.
    void add(Wrap wrap) {
        if (std::ranges::find(wraps_, wrap) == wraps_.end())
            wraps_.push_back(std::move(wrap));
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    const BufferSampler& sampler_;
    std::vector<Wrap> wraps_{};
};

/// Draws half of both dimensions and one pixel more, which look-ups at the edge mix in.
std::optional<Wrap> drawn_small(const ParsedText& text, NodeId main) {
    const std::vector<NodeId> parameters = parameters_of(text, main);
    if (parameters.size() != 2 || has_qualifier(text, text.tree().child(parameters[1], 0), "const"))
        return std::nullopt;
    const std::string_view colour = text.word_of(parameters[0]), place = text.word_of(parameters[1]);
    return at_word(text, text.tree()[body_of_function(text, main)].begin, "",
                   fmt::format(" if (any(greaterThan({1}, 0.5 * iResolution.xy + 1.0))) {{ {0} = "
                               "vec4(0.0); return; }} {1} *= 2.0;",
                               colour, place));
}

} // namespace

std::optional<Cut> half_size(std::span<const BufferReader> passes, size_t buffer, const WorkEstimate& work) {
    const ParsedText& text = passes[buffer].text;
    const NodeId main = find_main_image(text);
    if (main == k_no_node || !passes[buffer].samplers.empty() || says(text, "gl_FragCoord") ||
        says(text, "mainHit"))
        return std::nullopt;
    auto drawn = drawn_small(text, main);
    if (!drawn)
        return std::nullopt;
    const SourceLocation where = text.used(text.tree()[main].begin);
    Cut cut{{{*std::move(drawn)},
             fmt::format("{}:{}: draws the buffer at half its width and height", where.file, where.line)},
            work.of(body_of_function(text, main)) * k_saved,
            true};
    for (const BufferReader& reader : passes)
        for (const BufferSampler& sampler : reader.samplers) {
            auto wraps = LookUps(reader, sampler).run();
            if (!wraps)
                return std::nullopt;
            std::ranges::move(*wraps, std::back_inserter(cut.change.wraps));
        }
    const std::set<std::string> shared = shared_files(passes);
    const bool read = cut.change.wraps.size() > 1;
    const bool own = std::ranges::none_of(
        cut.change.wraps, [&](const Wrap& wrap) { return shared.contains(wrap.first.where.file); });
    return read && own ? std::optional(std::move(cut)) : std::nullopt;
}

} // namespace tidemark::glsl
