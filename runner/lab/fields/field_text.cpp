#include "lab/fields/field_text.hpp"

#include "base/hash.hpp"
#include "base/try.hpp"
#include "glsl/hit.hpp"
#include "glsl/specialise/globals.hpp"
#include "glsl/syntax/parsed_text.hpp"
#include "glsl/syntax/tree_facts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace tidemark::lab {
namespace {

using glsl::NodeKind;
using glsl::ParsedText;

constexpr std::string_view k_entries[] = {"mainHit", "march_sample"};
constexpr std::string_view k_solver = "march";

/// Names whose meaning the driver chooses: what depends on them is not in the text.
constexpr std::string_view k_of_the_driver[] = {"HW_PERFORMANCE", "__VERSION__", "__LINE__", "__FILE__"};

Result<std::unique_ptr<const ParsedText>> read(const scene::Scene& scene, const scene::Pass& pass) {
    text::MappedText text;
    text.append_generated(fmt::format("#version 330 core\n#define {} 1\n", glsl::k_hit_macro));
    if (pass.bare_file)
        text.append_generated("#define SHADER_TOY\n");
    text.append(scene.common);
    text.append(pass.text);
    for (const text::Token& token : text::tokenize(text.text()))
        if (std::ranges::find(k_of_the_driver, token.text) != std::end(k_of_the_driver))
            return fail(ErrorCode::load, fmt::format("the text asks for {}", token.text));
    return ParsedText::read(std::move(text), {}, false);
}

/// A declaration that does something beside declaring: it may set what the field reads.
bool acts(const ParsedText& text, const glsl::Global& global) {
    if (!global.root || text.tree()[global.node].kind != NodeKind::declaration)
        return false;
    const glsl::NodeId type = text.tree().child(global.node, 0);
    return !glsl::has_qualifier(text, type, "uniform");
}

} // namespace

Result<std::string> field_hash(const scene::Scene& scene) {
    if (!glsl::hit_scene(scene))
        return fail(ErrorCode::load, "the scene has no mainHit");
    const auto read_text = TRY(read(scene, scene.image()));
    const ParsedText& text = *read_text;
    const std::vector<glsl::Global> globals = glsl::find_globals(text);
    std::vector<bool> solver(text.words().size(), false), kept(globals.size());
    for (size_t i = 0; i < globals.size(); ++i) {
        const glsl::Node& node = text.tree()[globals[i].node];
        const bool function = node.kind == NodeKind::function;
        const auto is = [&](std::string_view name) { return function && globals[i].names.front() == name; };
        if (is(k_solver))
            std::fill(solver.begin() + long(node.begin), solver.begin() + long(node.end), true);
        kept[i] = std::ranges::any_of(k_entries, is) || acts(text, globals[i]);
    }
    const std::vector<bool> reached = glsl::find_reached(text, globals, solver, kept);
    std::string words;
    std::set<std::string_view> names;
    for (size_t i = 0; i < globals.size(); ++i) {
        const glsl::Node& node = text.tree()[globals[i].node];
        for (size_t word = node.begin; reached[i] && word < node.end; ++word)
            if (!solver[word]) {
                words += fmt::format("{} ", text.word(word));
                names.insert(text.word(word));
            }
    }
    for (const scene::Knob& knob : scene.knobs)
        if (names.contains(knob.name))
            words += fmt::format("knob {} {} ", scene::info(knob.type).directive_name, knob.name);
    return sha256(std::as_bytes(std::span(words)));
}

} // namespace tidemark::lab
