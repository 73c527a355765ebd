// Draws varied texts: the numbers that a driver makes of expressions in them.
#pragma once

#include "gl_test.hpp"
#include "lab/instrumented_pass.hpp"
#include "shader/source_edits.hpp"
#include "shader/variation.hpp"

#include <bit>
#include <cstdint>

namespace tidemark::lab {

class VariationTest : public render::RenderTest {
protected:
    /// The first `count` pixels of a scene that puts each expression into one, in the given mode.
    template <class Vary>
    std::vector<float> varied(Vary vary, int mode, const std::vector<std::string>& expressions,
                              const std::string& before) const {
        render::Renderer drawing = renderer(telling(expressions, before), {64, 1});
        const auto text = read_text(drawing, 0);
        EXPECT_TRUE(text) << to_string(text.error());
        const glsl::Variation made = vary(**text, glsl::find_facts(**text), {});
        const PassPreview preview(drawing, 0, {});
        auto stand_in = StandIn::link(preview, made.text, "a variation");
        if (!stand_in) {
            ADD_FAILURE() << to_string(stand_in.error()) << "\n" << made.text;
            return std::vector<float>(expressions.size());
        }
        stand_in->set(made.mode_uniform, mode);
        stand_in->set(made.filters_uniform, filters_);
        stand_in->draw(preview);
        return reds(stand_in->picture(), expressions.size());
    }
    /// The bits of the same.
    template <class Vary>
    std::vector<uint32_t> varied_bits(Vary vary, int mode, const std::vector<std::string>& expressions,
                                      const std::string& before) const {
        std::vector<uint32_t> bits;
        for (const float value : varied(vary, mode, expressions, before))
            bits.push_back(std::bit_cast<uint32_t>(value));
        return bits;
    }
    int filters_ = 0; ///< Variation::filters_uniform; 0: the text finds them out
};

inline constexpr int k_all_parts = (1 << glsl::k_swiftshader_parts) - 1;

inline glsl::Variation like_swiftshader(const glsl::ParsedText& text, const glsl::TreeFacts& facts,
                                        const glsl::MayVary& may) {
    return glsl::vary_like_swiftshader(text, facts, k_all_parts, {}, may);
}

/// Merges known numbers as SwiftShader's compiler does.
inline glsl::Variation like_its_compiler(const glsl::ParsedText& text, const glsl::TreeFacts& facts,
                                         const glsl::MayVary& may) {
    return glsl::vary_like_swiftshader(text, facts, k_all_parts, glsl::SwiftOrder::compiler, may);
}

} // namespace tidemark::lab
