#include "glsl/instrument/domains.hpp"

#include "glsl/instrument/domain_prelude.hpp"
#include "glsl/instrument/source_rewriter.hpp"
#include "glsl/syntax/builtin_functions.hpp"

#include <fmt/format.h>

#include <bit>
#include <limits>

namespace tidemark::glsl {
namespace {

bool is_equality(std::string_view op) {
    return op == "==" || op == "!=";
}

std::string_view comparison_name(std::string_view op) {
    return op == "<"    ? "less"
           : op == "<=" ? "less_equal"
           : op == ">"  ? "greater"
           : op == ">=" ? "greater_equal"
           : op == "==" ? "same"
                        : "other";
}

class DomainWatcher {
public:
    DomainWatcher(const ParsedText& text, const TreeFacts& facts)
        : text_(text), tree_(text.tree()), facts_(facts), prefix_(fresh_prefix(text)), edits_(text) {}

    DomainWatch run(DomainScope scope) {
        DomainWatch result{{},
                           find_domain_sites(text_, facts_, scope),
                           {},
                           prefix_ + "number",
                           prefix_ + "value",
                           prefix_ + "stride",
                           prefix_ + "left",
                           prefix_ + "down",
                           prefix_ + "count",
                           prefix_ + "width"};
        for (size_t i = 0; i < result.sites.size(); ++i) {
            const DomainSite& site = result.sites[i];
            const bool compares = site.kind == DomainKind::comparison;
            const bool equality = compares && is_equality(text_.word_of(site.node));
            std::string last = compares ? std::string() : fmt::format(",{}", i);
            for (int way = 0; way <= int(compares); ++way) {
                const bool room =
                    result.objectives.size() < DomainLayout::k_most_objectives && !(equality && way > 0);
                last += room ? fmt::format(",{}m[{}]", prefix_, result.objectives.size())
                             : fmt::format(",{}none", prefix_);
                if (room)
                    result.objectives.push_back({i, way > 0, equality});
            }
            lead(site, last + ")");
        }
        lead_main();
        result.text =
            headers_with_buffers(text_) +
            domain_prelude(text_, result.sites,
                           {prefix_, result.objectives.size(), result.sites.size() * DomainLayout::k_site}) +
            edits_.text() + domain_main(prefix_);
        return result;
    }

private:
    /// Routes the site's operation through our function; `last` are the arguments to append.
    void lead(const DomainSite& site, const std::string& last) {
        const NodeId id = site.node;
        switch (site.kind) {
        case DomainKind::function:
        case DomainKind::fetch: return lead_call(id, last);
        case DomainKind::quotient: return lead_quotient(id, last);
        case DomainKind::divisor: return wrap(tree_.child(id, 1), "divisor", last);
        case DomainKind::shift: return wrap(tree_.child(id, 1), "shift", last);
        case DomainKind::conversion: return wrap(id, site.to_unsigned ? "touint" : "toint", last);
        case DomainKind::index:
            return wrap(tree_.child(id, 1), "index",
                        fmt::format(",int({}.length()){}", words_of(text_, tree_.child(id, 0)), last));
        case DomainKind::comparison:
            edits_.wrap(id, fmt::format("{}{}(", prefix_, comparison_name(text_.word_of(id))), last);
            edits_.replace(tree_[id].word, ",");
        }
    }

    void wrap(NodeId id, std::string_view function, const std::string& last) {
        edits_.wrap(id, fmt::format("{}{}((", prefix_, function), ")" + last);
    }

    void lead_call(NodeId id, const std::string& last) {
        edits_.replace(tree_[tree_.child(id, 0)].word, prefix_ + std::string(called_name(text_, id)));
        edits_.replace(tree_[id].end - 1, last);
    }

    void lead_quotient(NodeId id, const std::string& last) {
        const std::string function = prefix_ + std::string(k_quotient);
        if (tree_[id].kind == NodeKind::binary) {
            edits_.replace(tree_[id].word, ",");
            edits_.wrap(id, function + "(", last);
            return;
        }
        edits_.replace(tree_[id].word, fmt::format("={}({},", function, words_of(text_, tree_.child(id, 0))));
        edits_.wrap(tree_.child(id, 1), "(", ")" + last);
    }

    void lead_main() {
        for (NodeId id = 1; id < tree_.nodes.size(); ++id) {
            const Node& node = tree_[id];
            if (node.kind == NodeKind::function && text_.word_of(id) == "main")
                edits_.replace(node.word, prefix_ + "main");
            else if (node.kind == NodeKind::name && text_.word_of(id) == "gl_FragCoord")
                edits_.replace(node.word, prefix_ + "place()");
            else if (node.kind == NodeKind::jump && text_.word_of(id) == "discard")
                edits_.wrap(id, fmt::format("{{{}flush();", prefix_), "}");
        }
    }

    const ParsedText& text_;
    const SyntaxTree& tree_;
    const TreeFacts& facts_;
    std::string prefix_;
    SourceRewriter edits_;
};

uint32_t word(std::span<const uint32_t> words, size_t at) {
    return at < words.size() ? words[at] : 0;
}

} // namespace

size_t DomainWatch::words() const {
    return sites.size() * DomainLayout::k_site + objectives.size() * DomainLayout::k_objective;
}

DomainReading reading_of(const DomainWatch&, std::span<const uint32_t> words, size_t site) {
    const size_t at = site * DomainLayout::k_site;
    return {word(words, at), ~word(words, at + 1), std::rotr(word(words, at + 2), 1), word(words, at + 3)};
}

DomainRoom room_of(const DomainWatch& watch, std::span<const uint32_t> words, size_t objective) {
    const size_t at = watch.sites.size() * DomainLayout::k_site + objective * DomainLayout::k_objective;
    const uint32_t key = word(words, at);
    if (key == 0)
        return {std::numeric_limits<float>::infinity(), 0};
    const uint32_t bits = key >> 31 != 0 ? key : ~key & 0x7fffffffu;
    return {std::bit_cast<float>(bits), word(words, at + 1) % DomainLayout::k_most_pixels};
}

DomainWatch watch_domains(const ParsedText& text, const TreeFacts& facts, DomainScope scope) {
    return DomainWatcher(text, facts).run(scope);
}

std::string_view domain_fault(std::string_view name, float argument) {
    const BuiltinFunction* const function = find_builtin(name);
    if (!function || !function->domain)
        return "of 0 and 0"; // a quotient
    const Domain& domain = *function->domain;
    const UndefinedWhere* const broken =
        domain.broken(domain.argument == "y" ? Arguments{0, argument, 0} : Arguments{argument, 0, 0});
    return (broken ? broken : domain.undefined)->fault;
}

} // namespace tidemark::glsl
