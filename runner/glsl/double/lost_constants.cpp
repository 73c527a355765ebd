#include "glsl/double/lost_constants.hpp"

#include "glsl/syntax/words.hpp"

#include <unordered_set>

namespace tidemark::glsl {
namespace {

using text::Token;
using text::TokenKind;

/// Limit of the passes over the lists: macros may name constants and constants macros, each defined after its
/// use.
constexpr int k_most_rounds = 6;

class LossFinder {
public:
    LossFinder(const Reading& reading, const std::function<bool(std::string_view)>& replaced)
        : reading_(reading), replaced_(replaced) {}

    std::vector<size_t> run() {
        for (int round = 0; round < k_most_rounds; ++round) {
            const size_t known = lost_names_.size();
            lost_.clear();
            for (const MacroLine& macro : reading_.preprocessed.macros)
                if (is_lost(macro.body, macro.end))
                    lost_names_.insert(macro.name);
            const std::vector<size_t>& code = reading_.preprocessed.code;
            for (size_t at = 0; at < code.size(); ++at)
                if (token(at).is("const") && at + 1 < code.size() && !is_parameter(at))
                    at = read_declaration(at);
            if (lost_names_.size() == known)
                break;
        }
        return std::move(lost_);
    }

private:
    const Token& token(size_t at) const { return reading_.tokens[reading_.preprocessed.code[at]]; }

    bool is_parameter(size_t at) const {
        return at > 0 && (token(at - 1).is("(") || token(at - 1).is(",") || token(at - 1).is("in"));
    }

    bool is_lost(const Token& word) const {
        return word.kind == TokenKind::identifier &&
               (lost_names_.contains(word.text) || replaced_(word.text));
    }

    bool is_lost(size_t begin, size_t end) const {
        for (size_t i = begin; i < end; ++i)
            if (is_lost(reading_.tokens[i]))
                return true;
        return false;
    }

    /// Reads `const T a = …, b = …;` at `at`: one lost value makes all its names lost. Returns the
    /// declaration's end.
    size_t read_declaration(size_t at) {
        std::vector<std::string_view> names;
        bool lost = false, value = false;
        int depth = 0;
        size_t i = at + 1;
        for (; i < reading_.preprocessed.code.size() && !token(i).is(";") && depth >= 0; ++i) {
            const Token& word = token(i);
            depth += nesting(word.text);
            if (depth == 0 && word.is(","))
                value = false;
            else if (depth == 0 && word.is("="))
                value = true;
            else if (value)
                lost = lost || is_lost(word);
            else if (depth == 0 && word.kind == TokenKind::identifier)
                names.push_back(word.text);
        }
        if (lost) {
            lost_.push_back(reading_.preprocessed.code[at]);
            lost_names_.insert(names.begin(), names.end());
        }
        return i;
    }

    const Reading& reading_;
    const std::function<bool(std::string_view)>& replaced_;
    std::unordered_set<std::string_view> lost_names_;
    std::vector<size_t> lost_;
};

} // namespace

std::vector<size_t> find_lost_constants(const Reading& reading,
                                        const std::function<bool(std::string_view)>& replaced) {
    return LossFinder(reading, replaced).run();
}

} // namespace tidemark::glsl
