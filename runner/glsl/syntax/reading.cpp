#include "glsl/syntax/reading.hpp"

#include "glsl/syntax/words.hpp"

#include <algorithm>

namespace tidemark::glsl {
namespace {

/// Maps each opening token to the token that closes it, whatever their kinds are; to the token count if none
/// does.
std::vector<size_t> find_closing(const std::vector<text::Token>& tokens) {
    std::vector<size_t> closing(tokens.size(), tokens.size());
    std::vector<size_t> open;
    for (size_t i = 0; i < tokens.size(); ++i) {
        const text::Token& token = tokens[i];
        if (nesting(token.text) > 0) {
            open.push_back(i);
        } else if (!open.empty() && nesting(token.text) < 0) {
            closing[open.back()] = i;
            open.pop_back();
        }
    }
    return closing;
}

} // namespace

Reading::Reading(std::string_view text)
    : tokens(text::tokenize(text)), preprocessed(preprocess(tokens, {})),
      functions(find_functions(tokens, preprocessed)), places(tokens.size(), Place::code),
      closing_(find_closing(tokens)) {
    for (size_t i = 0; i < tokens.size(); ++i)
        if (tokens[i].first_on_line && tokens[i].is("#"))
            std::fill(places.begin() + long(i), places.begin() + long(text::end_of_directive(tokens, i)),
                      Place::directive);
    for (const Function& function : functions)
        overloads[function.name].push_back(&function);
    for (const MacroLine& macro : preprocessed.macros) {
        std::fill(places.begin() + long(macro.hash), places.begin() + long(macro.body), Place::macro_head);
        std::fill(places.begin() + long(macro.body), places.begin() + long(macro.end), Place::macro_body);
        if (!macro.undefines)
            macros.emplace(macro.name, &macro);
    }
}

bool Reading::defines(std::string_view name) const {
    return macros.contains(name) || overloads.contains(name);
}

size_t Reading::closing(size_t open, size_t end) const {
    return std::min(closing_[open], end);
}

bool Reading::is_pair(size_t i, std::string_view two) const {
    return i + 1 < tokens.size() && tokens[i].is(two.substr(0, 1)) && tokens[i + 1].is(two.substr(1)) &&
           tokens[i + 1].glued;
}

} // namespace tidemark::glsl
