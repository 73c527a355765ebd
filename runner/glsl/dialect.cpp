#include "glsl/dialect.hpp"

namespace tidemark::glsl {

std::string to_string(const Dialect&) {
    return "330 core";
}

std::vector<Dialect> dialects_to_try(const scene::Scene&, const scene::Pass&) {
    return {Dialect{}};
}

std::vector<ChannelKinds> channel_kinds_to_try(const scene::Scene&, const scene::Pass&,
                                               const text::MappedText&, std::string_view) {
    return {};
}

std::vector<Diagnostic> entry_point_problems(const scene::Scene&, const scene::Pass&) {
    return {};
}

} // namespace tidemark::glsl
