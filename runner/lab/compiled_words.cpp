#include "lab/compiled_words.hpp"

#include "glsl/assemble.hpp"
#include "glsl/syntax/parsed_text.hpp"

namespace tidemark::lab {

std::optional<std::vector<std::string>> compiled_words(const scene::Scene& scene) {
    std::vector<std::string> words;
    for (const scene::Pass& pass : scene.passes) {
        const auto text = glsl::ParsedText::read(glsl::assemble(scene, pass), {}, false);
        if (!text)
            return std::nullopt;
        for (const glsl::Word& word : (*text)->words())
            words.emplace_back(word.text);
    }
    return words;
}

} // namespace tidemark::lab
