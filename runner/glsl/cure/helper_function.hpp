// Cures that call a function of their own, which comes to stand in front of the first function that calls it:
// one cure for each file.
#pragma once

#include "glsl/cure/written.hpp"

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

class HelperFunction {
public:
    /// `name` gets a number where a word of the text has it already.
    HelperFunction(const ParsedText& text, std::string_view name) : text_(text), wanted_(name) {}

    /// What stands instead of an expression, by the function's name; nothing: it stays.
    using Say = std::function<std::optional<std::string>(const std::string& name)>;
    void use(NodeId expression, const Say& say);

    /// `define` gives the function by its name, on one line.
    std::vector<Cure> cures(const std::function<std::string(const std::string& name)>& define,
                            const std::string& reason) const;

private:
    struct Uses {
        std::string name;
        Wrap first; ///< word of the first function
        std::vector<Wrap> wraps{};
    };

    const ParsedText& text_;
    std::string wanted_;
    std::map<std::string, Uses> files_{};
};

} // namespace tidemark::glsl
