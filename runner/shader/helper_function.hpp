// Builds fixes that call a function of their own, which is inserted before the first function that calls it:
// one fix per file.
#pragma once

#include "shader/fixes.hpp"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::glsl {

class HelperFunction {
public:
    /// `name` gets a number if the text already uses it.
    HelperFunction(const ParsedText& text, std::string_view name) : text_(text), wanted_(name) {}

    /// Returns the text that replaces an expression, given the function's name; nothing: the expression
    /// stays.
    using Say = std::function<std::optional<std::string>(const std::string& name)>;
    void use(NodeId expression, const Say& say);

    /// `define` returns the function's definition for its name, on one line.
    std::vector<Cure> cures(const std::function<std::string(const std::string& name)>& define,
                            const std::string& reason) const;

private:
    struct Uses {
        std::string name;
        Wrap first; ///< token at the start of the first function that uses it
        std::vector<Wrap> wraps{};
    };

    const ParsedText& text_;
    std::string wanted_;
    std::map<std::string, Uses> files_{};
};

} // namespace tidemark::glsl
